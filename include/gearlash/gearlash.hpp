// All of Gearlash in one header.
#pragma once

#include "gearlash/analyse.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/controller.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/hybrid.hpp"
#include "gearlash/input.hpp"
#include "gearlash/motion.hpp"
#include "gearlash/output.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/progress.hpp"
#include "gearlash/quantity.hpp"
#include "gearlash/sensitivity.hpp"
#include "gearlash/signal.hpp"
#include "gearlash/version.hpp"
