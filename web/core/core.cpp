#include "core.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <optional>

#include "drive_reply.hpp"
#include "gearlash/design.hpp"
#include "grid_reply.hpp"
#include "input/axis_text.hpp"
#include "limited_progress.hpp"
#include "output/answer_report.hpp"
#include "output/parameter_text.hpp"
#include "picture/answer_picture.hpp"
#include "picture/attractor_picture.hpp"
#include "picture_reply.hpp"
#include "question/analyse.hpp"
#include "thesis/figures.hpp"

namespace gearlash::web {
namespace {

Json faults_json(const std::vector<Fault>& faults) {
  return json_list(faults, [](const Fault& fault) {
    const std::string plain = fault.path.substr(0, fault.path.find('['));
    return Json{{"path", fault.path},
                {"is_parameter", find_parameter(plain) != nullptr},
                {"value", fault.value},
                {"permitted", fault.permitted},
                {"where", fault.where}};
  });
}

/// Texts of one number. Values beyond which hunting ends or begins are rounded to that side.
struct NumberText {
  std::function<std::string(double)> of;
  std::function<std::string(double)> at_least;
  std::function<std::string(double)> at_most;
};

NumberText text_of_parameter(const ParameterText& words) {
  return {.of = [&words](double value) { return words.of(value); },
          .at_least = [&words](double value) { return words.at_least(value); },
          .at_most = [&words](double value) { return words.at_most(value); }};
}

/// The present value and the nearest ones at which hunting ends or begins, as a reader has them.
Json margin_texts(const ParameterMargin& margin, const std::string& description, bool is_setting,
                  const NumberText& text) {
  return {{"parameter", margin.parameter},
          {"description", description},
          {"is_setting", is_setting},
          {"is_certified", margin.kind == SearchKind::certified},
          {"present", text.of(margin.present)},
          {"below", margin.below ? Json(text.at_most(*margin.below)) : Json(nullptr)},
          {"above", margin.above ? Json(text.at_least(*margin.above)) : Json(nullptr)},
          {"searched", text.of(margin.searched.low) + " to " + text.of(margin.searched.high)},
          {"choices", json_list(margin.choices, text.of)}};
}

Json margins_json(const DriveText& text, const WrittenDrive& written, const HuntingMargin& margin) {
  const ShownUnits units(text, written);
  return {{"hunts", margin.hunts},
          {"is_known", margin.is_known},
          {"is_complete", !margin.stopped},
          {"texts", json_list(margin.parameters, [&](const ParameterMargin& one) {
             const Axis axis{.path = one.parameter};
             const Parameter& parameter = *parameter_of(axis, written.drive);
             ParameterText words(written.drive, one.parameter, written.angle);
             const ShownUnit unit = units.of(parameter);
             words.show_in(unit.name, unit.in_si);
             return margin_texts(one, std::string(parameter.meaning),
                                 exists(parameter, written.drive), text_of_parameter(words));
           })}};
}

}  // namespace

/// One page: its drive, its last answer, and the columns of the reply at hand.
class Core::Session {
 public:
  explicit Session(Host host) : host_(std::move(host)) {}

  Json reply_to(const Json& request) {
    numbers_ = Numbers();
    LimitedProgress progress(host_, request.value("seconds", infinity));
    const std::string ask = request.at("ask");
    if (ask == "thesis") return thesis_figure(request.at("figure"), progress);
    const DriveText text = drive_text_of(request.at("drive"));
    const WrittenDrive written = parse(text, host_.folder);
    if (ask == "drive") return drive_reply(text, written);
    if (ask == "file") return file_reply(written);
    if (ask == "answer") return answer(request, text, written, progress);
    if (ask == "map") return map_reply(request, written, numbers_, progress);
    if (ask == "chart") return chart_reply(request, written, numbers_, progress);
    if (ask == "margins") return margins(request, text, written, progress);
    refuse("ask", ask, "must be thesis, drive, file, answer, map, chart or margins");
  }

  std::vector<double> take_numbers() { return numbers_.take(); }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Coarse: without proofs and borders; a search follows that of the drive before, or one start.
  Analysis analysed(bool is_coarse, const WrittenDrive& written, Progress& progress) {
    Wanted wanted{
        .proofs = !is_coarse, .ceiling = true, .borders = !is_coarse, .quantization = !is_coarse};
    if (!is_coarse) return analyse_in_full(written.drive, wanted, progress);
    return analyse_until(
        written.drive, wanted,
        [](const drive::AttractorSearch& search) { return !search.outcomes.empty(); }, progress,
        last_ ? &*last_ : nullptr);
  }

  /// How the answer was found, for the page to say.
  static const char* means_of(const Analysis& analysis, bool is_coarse) {
    if (analysis.closed) return "closed form";
    if (analysis.search->outcomes.empty()) return "proof by energy";
    if (analysis.is_followed) return "followed";
    return is_coarse ? "one start" : "search";
  }

  Json answer(const Json& request, const DriveText& text, const WrittenDrive& written,
              Progress& progress) {
    const bool is_coarse = request.value("level", "fine") == "coarse";
    if (last_toml_ != text.toml) last_.reset();  // another drive
    const Analysis analysis = analysed(is_coarse, written, progress);
    const AnswerReport report = report_of(written.drive, analysis.answer, written.angle, {});
    Json json = {{"level", is_coarse ? "coarse" : "fine"},
                 {"means", means_of(analysis, is_coarse)},
                 {"is_complete", !analysis.search || analysis.search->is_complete},
                 {"headline", headline(report)},
                 {"report", is_coarse ? Json(nullptr) : Json(answer_text(report))},
                 {"answer", Json::parse(answer_json(report))},
                 {"unit", written.angle.name},
                 {"unit_in_si", written.angle.radians}};
    if (is_drawn(analysis)) {
      json["response"] = motion_picture_json(response_picture(report, analysis), numbers_);
      MotionPicture phase = phase_of(report, analysis, is_coarse, progress);
      json["phase"] = phase_json(phase);
      std::erase_if(phase.motions, [](const DrawnMotion& drawn) { return !drawn.is_cycle; });
      json["cycles"] = motion_picture_json(phase, numbers_);
    }
    // What is known of a drive with one start is too little to follow; and where following failed,
    // trying it again from ever farther away would cost more than the start.
    last_.reset();
    if (!is_coarse || analysis.is_followed) {
      last_ = analysis;
      last_toml_ = text.toml;
    }
    return json;
  }

  /// Null for motions with too many events to draw.
  Json phase_json(const MotionPicture& picture) {
    try {
      return plot_json(phase_plot(picture), numbers_);
    } catch (const InvalidInput&) {
      return nullptr;
    }
  }

  static bool is_drawn(const Analysis& analysis) {
    return analysis.closed || !analysis.search->outcomes.empty();
  }

  /// While dragging, no starts are watched for the picture alone.
  static MotionPicture phase_of(const AnswerReport& report, const Analysis& analysis,
                                bool is_coarse, Progress& progress) {
    if (!is_coarse || analysis.closed) return phase_picture(report, analysis, progress);
    return attractor_picture(headline(report), report.drive, analysis.reduced, *analysis.search,
                             report.angle);
  }

  static Json margins(const Json& request, const DriveText& text, const WrittenDrive& written,
                      Progress& progress) {
    std::vector<Axis> axes;
    for (const Json& path : request.value("parameters", Json::array())) {
      axes.push_back(read_axis_to_search("parameters", path.get<std::string>(), written.drive));
    }
    if (!axes.empty()) {
      return margins_json(text, written, gearlash::margins(written.drive, axes, progress));
    }
    return margins_json(text, written, gearlash::margins(written.drive, progress));
  }

  Json thesis_figure(int number, Progress& progress) {
    for (const thesis::PhaseFigure& figure : thesis::thesis_phase_figures()) {
      if (figure.number == number) return plot_json(plot_of(figure), numbers_);
    }
    for (const thesis::Figure& figure : thesis::thesis_figures()) {
      if (figure.number == number) return plot_json(plot_of(figure, progress), numbers_);
    }
    refuse("figure", std::to_string(number), "must be the number of a figure: 2 to 15");
  }

  Host host_;
  Numbers numbers_;
  std::optional<Analysis> last_;
  std::string last_toml_;
};

Core::Core(Host host) : session_(std::make_unique<Session>(std::move(host))) {}
Core::~Core() = default;

Reply Core::ask(std::string_view request) {
  Reply reply;
  Json json;
  try {
    json = session_->reply_to(Json::parse(request));
    reply.numbers = session_->take_numbers();
  } catch (const InvalidInput& error) {
    json = {{"faults", faults_json(error.faults())}};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    json = {{"failure", error.what()}};
  }
  reply.json = json.dump();
  return reply;
}

}  // namespace gearlash::web
