// Every contestant as a function of a problem, so that one loop measures and checks them all.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "problems.hpp"
#include "rival.hpp"

namespace gearlash::benchmarks {

/// Where a limit cycle is sought from.
enum class Start {
  from_rest,  ///< step response, what one does who does not know the cycle
  near_cycle  ///< our exact cycle, its starting state 1 % off: the best that a rival can hope for
};

enum class Contact { plastic, bouncing };

/// All of a race's problems made ready (solvers allocated); calling it does the work once and
/// writes an amplitude and a period for each. What is made ready is not measured.
using Task = std::function<void(std::vector<RivalCycle>& answers)>;

struct Contestant {
  std::string name;
  bool yardstick = false;  ///< the others' times are told in multiples of this one's
  std::function<Task(const std::vector<Problem>&)> prepare;
};

/// Finding a limit cycle. Ours are find_limit_cycles() with each vector unit of this machine,
/// several servos side by side, and analyse_limit_cycles(), one by one: data in, every property
/// out.
std::vector<Contestant> limit_cycle_contestants(Start start, Contact contact);

/// Those who follow a motion until it settles, from rest: the rivals, and the program of 1960, in
/// C++ and double precision and with its own step, for as long as its cycles still change by a
/// thousandth.
std::vector<Contestant> settling_contestants();

/// Following the exact cycle from one separation to the next: flight, impacts, engagement.
std::vector<Contestant> half_cycle_contestants();

}  // namespace gearlash::benchmarks
