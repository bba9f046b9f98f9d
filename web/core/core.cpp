#include "core.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "drive_reply.hpp"
#include "gearlash/design.hpp"
#include "gearlash/input.hpp"
#include "gearlash/picture.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_report.hpp"
#include "output/drive_text.hpp"
#include "output/json_writer.hpp"
#include "output/parameter_text.hpp"
#include "output/records.hpp"
#include "picture/answer_picture.hpp"
#include "picture/attractor_picture.hpp"
#include "picture/grid_words.hpp"
#include "picture/motion_style.hpp"
#include "question/analyse.hpp"
#include "thesis/figures.hpp"
#include "web/reply_records.hpp"

namespace gearlash::web {

const char* name_of(Means means) {
  constexpr std::array names = {"closed form", "proof by energy", "followed", "one start",
                                "search"};
  return names.at(static_cast<std::size_t>(means));
}

namespace {

std::vector<ShownFault> shown(const std::vector<Fault>& faults) {
  return of_each(faults, [](const Fault& fault) {
    const std::string plain = fault.path.substr(0, fault.path.find('['));
    return ShownFault{fault.path, find_parameter(plain) != nullptr, fault.value, fault.permitted,
                      fault.where};
  });
}

/// With its points beside it.
template <class Of>
Reply written(const Of& reply) {
  Reply made;
  made.json = json_of(reply, &made.numbers);
  return made;
}

MarginText text_of(const ParameterMargin& margin, const WrittenDrive& written,
                   const ShownUnits& units) {
  const Parameter& parameter = *parameter_of(Axis{.path = margin.parameter}, written.drive);
  ParameterText words(written.drive, margin.parameter);
  const ShownUnit unit = units.of(parameter);
  words.show_in(unit.name, unit.in_si);
  MarginText text{
      .parameter = margin.parameter,
      .description = std::string(parameter.meaning),
      .is_setting = exists(parameter, written.drive),
      .is_certified = margin.kind == SearchKind::certified,
      .present = words.of(margin.present),
      .searched = words.of(margin.searched.low) + " to " + words.of(margin.searched.high)};
  if (margin.below) text.below = words.at_most(*margin.below);
  if (margin.above) text.above = words.at_least(*margin.above);
  text.choices = of_each(margin.choices, [&](double choice) { return words.of(choice); });
  return text;
}

MarginsReply reply_of(const HuntingMargin& margin, const DriveText& text,
                      const WrittenDrive& written) {
  const ShownUnits units(text, written);
  return {.hunts = margin.hunts,
          .is_known = margin.is_known,
          .is_complete = !margin.stopped,
          .texts = of_each(margin.parameters, [&](const ParameterMargin& one) {
            return text_of(one, written, units);
          })};
}

}  // namespace

/// Reports to the page, and stops the work after some seconds.
class LimitedProgress : public Progress {
 public:
  LimitedProgress(const Host& host, double seconds)
      : host_(host), until_(host.seconds() + seconds), next_report_(host.seconds()) {}

  bool go_on(double share, std::size_t) override {
    const double now = host_.seconds();
    if (now >= next_report_) {
      host_.report(share);
      next_report_ = now + seconds_between_reports;
    }
    is_stopped_ = now >= until_;
    return !is_stopped_;
  }
  bool is_stopped() const { return is_stopped_; }

 private:
  static constexpr double seconds_between_reports = 0.1;

  const Host& host_;
  double until_;
  double next_report_;
  bool is_stopped_ = false;
};

/// Over time, and as two gears: the first motion of the picture. One with too many events to draw
/// has a reason instead.
ShownMotion motion_reply(const std::string& name, const MotionPicture& picture) {
  const Motion& motion = picture.motions.front().motion;
  ShownMotion shown{.name = name,
                    .time_unit = is_normalized(picture.drive) ? "1/ω_n" : "s",
                    .gap = picture.drive.angle_unit.from_radians(reduce(picture.drive).backlash)};
  try {
    shown.plot = time_plot(picture);
    for_each_point(legible_curve(picture, motion), [&](const DrawnPoint& point) {
      shown.load.push_back({point.time, point.load_position - point.reference});
      shown.motor.push_back({point.time, point.motor_position - point.reference});
    });
  } catch (const InvalidInput& error) {
    shown.reason = error.what();
    return shown;
  }
  shown.events = of_each(motion.events(), [](const MotionEvent& event) {
    return ShownEvent{event.time, std::string(event.what), std::string(event.mode_after)};
  });
  return shown;
}

/// One page: its drive and its last answer.
class Core::Session {
 public:
  explicit Session(Host host) : host_(std::move(host)) {}

  Reply reply_to(const Json& request) {
    LimitedProgress progress(host_, request.value("seconds", infinity));
    const std::string ask = request.at("ask");
    if (ask == "thesis") return written(thesis_figure(request.at("figure"), progress));
    const DriveText text = drive_text_of(request.at("drive"));
    const WrittenDrive drive = parse(text, host_.folder);
    if (ask == "drive") return written(drive_reply(text, drive));
    if (ask == "file") {
      return written(FileReply{to_toml(TolerancedDrive{drive.drive, drive.tolerances})});
    }
    if (ask == "answer") return written(answer(request, text, drive, progress));
    if (ask == "margins") return written(margins(request, text, drive, progress));
    if (ask == "picture") return written(picture(request, drive, progress));
    refuse("ask", ask, "must be thesis, drive, file, answer, margins or picture");
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr auto& kinds = records::Words<PictureKind>::all;

  /// Coarse: without proofs and borders; a search follows that of the drive before, or one start.
  Analysis analysed(bool is_coarse, const WrittenDrive& written, Progress& progress) {
    if (!is_coarse) return analyse_in_full(written.drive, wanted_of_report(), progress);
    return analyse_in_full(
        written.drive, {.proofs = false, .ceiling = true, .borders = false}, progress,
        {.near = last_ ? &*last_ : nullptr, .is_enough = [](const drive::AttractorSearch& search) {
           return !search.outcomes.empty();
         }});
  }

  /// How the answer was found, for the page to say.
  static Means means_of(const Analysis& analysis, bool is_coarse) {
    if (analysis.closed) return Means::closed_form;
    if (analysis.search->outcomes.empty()) return Means::proof_by_energy;
    if (analysis.is_followed) return Means::followed;
    return is_coarse ? Means::one_start : Means::search;
  }

  AnswerReply answer(const Json& request, const DriveText& text, const WrittenDrive& written,
                     Progress& progress) {
    const bool is_coarse = request.value("level", "fine") == "coarse";
    if (last_toml_ != text.toml) last_.reset();  // another drive
    const Analysis analysis = analysed(is_coarse, written, progress);
    const AnswerReport report = report_of(written.drive, analysis.answer, {});
    AnswerReply reply{.level = is_coarse ? Level::coarse : Level::fine,
                      .means = means_of(analysis, is_coarse),
                      .is_complete = !analysis.search || analysis.search->is_complete,
                      .headline = headline(report),
                      .report = is_coarse ? "" : answer_text(report),
                      .answer = report.answer,
                      .unit = written.drive.angle_unit.name,
                      .unit_in_si = written.drive.angle_unit.radians};
    if (is_drawn(analysis)) {
      reply.motions = {motion_reply("the way there", response_picture(report, analysis))};
      add_cycles(phase_of(report, analysis, is_coarse, progress), reply);
    }
    // What is known of a drive with one start is too little to follow; and where following failed,
    // trying it again from ever farther away would cost more than the start.
    last_.reset();
    if (!is_coarse || analysis.is_followed) {
      last_ = analysis;
      last_toml_ = text.toml;
    }
    return reply;
  }

  /// The phase plane, unless there are too many events to draw, and each cycle over time.
  static void add_cycles(MotionPicture picture, AnswerReply& reply) {
    try {
      reply.phase = phase_plot(picture);
    } catch (const InvalidInput&) {  // the motions say it too
    }
    for (const DrawnMotion& motion : std::exchange(picture.motions, {})) {
      if (!motion.is_cycle) continue;
      picture.motions = {motion};
      reply.motions.push_back(motion_reply(motion.name.empty() ? "cycle" : motion.name, picture));
    }
  }

  static bool is_drawn(const Analysis& analysis) {
    return analysis.closed || !analysis.search->outcomes.empty();
  }

  /// While dragging, no starts are watched for the picture alone.
  static MotionPicture phase_of(const AnswerReport& report, const Analysis& analysis,
                                bool is_coarse, Progress& progress) {
    if (!is_coarse || analysis.closed) return phase_picture(report, analysis, progress);
    return attractor_picture(headline(report), report.drive, analysis.reduced, *analysis.search);
  }

  static MarginsReply margins(const Json& request, const DriveText& text,
                              const WrittenDrive& written, Progress& progress) {
    const std::vector<Axis> axes =
        of_each(request.value("parameters", Json::array()), [&](const Json& path) {
          return read_axis_to_search("parameters", path.get<std::string>(), written.drive);
        });
    return reply_of(gearlash::margins(written.drive, axes, progress), text, written);
  }

  /// More points than a picture shows would keep the page waiting.
  static void require_few(const std::vector<Axis>& axes) {
    constexpr double most_points = 40'000;
    double points = 1.0;  // their product may be larger than a std::size_t of WebAssembly
    for (const Axis& axis : axes) points *= static_cast<double>(axis.values.size());
    if (points <= most_points) return;
    refuse("points", exact_text(points),
           "must be at most " + exact_text(most_points) +
               " in the page; the command line has room for more");
  }

  /// The drive's picture of a kind, over the axes of the request.
  static PictureReply picture(const Json& request, const WrittenDrive& written,
                              LimitedProgress& progress) {
    PictureQuestion question{
        .drive = written.drive, .marks_drive = false, .varied = written.tolerances};
    const std::string kind = request.at("kind");
    const auto* const known = std::find_if(std::begin(kinds), std::end(kinds),
                                           [&](const auto& one) { return one.text == kind; });
    if (known == std::end(kinds)) refuse("kind", kind, "must be the kind of a picture");
    question.kind = known->value;
    PictureReply reply;
    const auto read = [&](const char* name, std::optional<DrawnAxis>& drawn) {
      if (!request.contains(name)) return;
      const std::string text = request.at(name);
      const Axis axis = read_axis_or_name(name, text, written.drive);
      question.axes.push_back(axis);
      drawn = {axis.path, drawn_unit(axis, written.drive).size};
    };
    read("y", reply.y);
    read("x", reply.x);
    require_few(question.axes);
    reply.plot = picture_of(question, progress);
    reply.is_complete = !progress.is_stopped();
    return reply;
  }

  static Plot thesis_figure(int number, Progress& progress) {
    if (const auto plot = thesis::figure_plot(number, progress)) return *plot;
    refuse("figure", std::to_string(number), "must be the number of a figure: 2 to 15");
  }

  Host host_;
  std::optional<Analysis> last_;
  std::string last_toml_;
};

Core::Core(Host host) : session_(std::make_unique<Session>(std::move(host))) {}
Core::~Core() = default;

Reply Core::ask(std::string_view request) {
  try {
    return session_->reply_to(Json::parse(request));
  } catch (const InvalidInput& error) {
    return written(FaultsReply{shown(error.faults())});
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return written(FailureReply{error.what()});
  }
}

}  // namespace gearlash::web
