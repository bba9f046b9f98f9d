#include "plain_signal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace gearlash::oracle {
namespace {

using Pieces = std::vector<PlainCourse::Piece>;

PlainSignal plainly(double value) { return {value, {}}; }

PlainSignal plainly(const StepSignal& step) {
  const double change = step.before - step.after;
  return {step.after, {.pieces = {{step.time, change}, {step.time, 0.0}}}};
}

PlainSignal plainly(const RampSignal& ramp) {
  if (ramp.rate == 0.0) return plainly(ramp.value);
  return {ramp.value, {.pieces = {{ramp.time, 0.0}, {ramp.time, 0.0, ramp.rate}}}};
}

PlainSignal plainly(const SineSignal& sine) {
  return {sine.mean,
          {.amplitude = sine.amplitude, .frequency = sine.frequency, .phase = sine.phase}};
}

/// With the top speed v and the acceleration a, a distance d takes d/v + v/a.
PlainSignal plainly(const TrapezoidSignal& move) {
  const double way = move.to > move.from ? 1.0 : -1.0;
  const double distance = std::abs(move.to - move.from);
  if (distance == 0.0) return plainly(move.to);
  const double speed = std::min(move.speed, std::sqrt(distance * move.acceleration));
  const double ramp = speed / move.acceleration;
  const double half = 0.5 * speed * ramp;
  const double from = move.from - move.to;
  const double brakes = move.time + distance / speed;
  const Pieces pieces = {{move.time, from},
                         {move.time, from, 0.0, way * move.acceleration},
                         {move.time + ramp, from + way * half, way * speed},
                         {brakes, -way * half, way * speed, -way * move.acceleration},
                         {brakes + ramp, 0.0}};
  return {move.to, {.pieces = pieces}};
}

PlainSignal plainly(const TableSignal& table) {
  const double last = table.values.back();
  Pieces pieces = {{table.times.front(), table.values.front() - last}};
  for (std::size_t i = 0; i + 1 < table.times.size(); ++i) {
    const double rise = table.values[i + 1] - table.values[i];
    pieces.push_back(
        {table.times[i], table.values[i] - last, rise / (table.times[i + 1] - table.times[i])});
  }
  pieces.push_back({table.times.back(), 0.0});
  return {last, {.pieces = pieces}};
}

}  // namespace

const PlainCourse::Piece& PlainCourse::piece_at(double time) const {
  const auto later =
      std::upper_bound(pieces.begin(), pieces.end(), time,
                       [](double wanted, const Piece& piece) { return wanted < piece.start; });
  return later == pieces.begin() ? pieces.front() : *(later - 1);
}

double PlainCourse::at(double time) const {
  if (amplitude != 0.0) return amplitude * std::sin(frequency * time + phase);
  if (pieces.empty()) return 0.0;
  const Piece& piece = piece_at(time);
  const double since = std::max(0.0, time - piece.start);
  return piece.value + since * (piece.rate + 0.5 * since * piece.acceleration);
}

double PlainCourse::rate_at(double time) const {
  if (amplitude != 0.0) return amplitude * frequency * std::cos(frequency * time + phase);
  if (pieces.empty()) return 0.0;
  const Piece& piece = piece_at(time);
  return piece.rate + std::max(0.0, time - piece.start) * piece.acceleration;
}

double PlainCourse::acceleration_at(double time) const {
  if (amplitude != 0.0) return -frequency * frequency * at(time);
  const bool is_before = pieces.empty() || time < pieces.front().start;
  return is_before ? 0.0 : piece_at(time).acceleration;
}

double PlainCourse::fastest() const {
  double fastest = std::abs(amplitude * frequency);
  for (const Piece& piece : pieces) fastest = std::max(fastest, std::abs(piece.rate));
  return fastest;
}

double PlainCourse::size() const {
  double size = std::abs(amplitude);
  for (const Piece& piece : pieces) size = std::max(size, std::abs(piece.value));
  return size;
}

double PlainCourse::period() const {
  return amplitude == 0.0 ? 0.0 : 2.0 * std::numbers::pi / frequency;
}

PlainCourse PlainCourse::settled() const {
  if (pieces.empty()) return *this;
  if (last_rate() == 0.0) return {};
  return {.pieces = {{0.0, 0.0, last_rate()}}};
}

PlainSignal plain_signal(const Signal& signal) {
  return std::visit([](const auto& one) { return plainly(one); }, signal);
}

}  // namespace gearlash::oracle
