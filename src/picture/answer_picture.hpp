// The motions of an answer of either engine, for pictures.
#pragma once

#include "output/answer_report.hpp"
#include "picture/motion_picture.hpp"
#include "question/analyse.hpp"

namespace gearlash {

/// The cycles in the phase plane with motions that lead to them, and the basins if starts lead to
/// different ends; these are watched, and left out where `progress` stops that.
MotionPicture phase_picture(const AnswerReport& report, const Analysis& analysis,
                            Progress& progress = no_progress());

/// The motion that leads to the hunting, over time.
MotionPicture response_picture(const AnswerReport& report, const Analysis& analysis);

}  // namespace gearlash
