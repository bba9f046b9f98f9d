#include "cvode_rival.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gearlash::benchmarks {
namespace {

/// What the callbacks need.
struct Problem {
  Coefficients servo;
  double face = 1.0;
  double near_face_margin = 0.0;
};

const Problem& problem_of(void* data) { return *static_cast<const Problem*>(data); }

int engaged_derivative(realtype, N_Vector state, N_Vector rate, void* data) {
  const Coefficients& servo = problem_of(data).servo;
  const double* z = NV_DATA_S(state);
  double* r = NV_DATA_S(rate);
  r[0] = z[1];
  r[1] = -servo.friction() * z[1] - z[0];
  return 0;
}

int engaged_jacobian(realtype, N_Vector, N_Vector, SUNMatrix jacobian, void* data, N_Vector,
                     N_Vector, N_Vector) {
  SM_ELEMENT_D(jacobian, 0, 1) = 1.0;
  SM_ELEMENT_D(jacobian, 1, 0) = -1.0;
  SM_ELEMENT_D(jacobian, 1, 1) = -problem_of(data).servo.friction();
  return 0;
}

/// Mesh torque towards the face, and the load's speed (turning point).
int engaged_roots(realtype, N_Vector state, realtype* values, void* data) {
  const Problem& problem = problem_of(data);
  const double* z = NV_DATA_S(state);
  values[0] = problem.face * problem.servo.torque(z[0], z[1]);
  values[1] = z[1];
  return 0;
}

int gap_derivative(realtype, N_Vector state, N_Vector rate, void* data) {
  const Coefficients& servo = problem_of(data).servo;
  const double* z = NV_DATA_S(state);
  double* r = NV_DATA_S(rate);
  r[0] = z[1];
  r[3] = servo.load_acceleration(z[3]);
  r[1] = servo.motor_acceleration(z[2], z[3] + z[1]) - r[3];
  r[2] = z[3];
  return 0;
}

int gap_jacobian(realtype, N_Vector, N_Vector, SUNMatrix jacobian, void* data, N_Vector, N_Vector,
                 N_Vector) {
  const Coefficients& servo = problem_of(data).servo;
  const double motor_rate = servo.motor_friction / servo.motor_inertia;
  const double load_rate = servo.load_friction / servo.load_inertia;
  SM_ELEMENT_D(jacobian, 0, 1) = 1.0;
  SM_ELEMENT_D(jacobian, 1, 1) = -motor_rate;
  SM_ELEMENT_D(jacobian, 1, 2) = -1.0 / servo.motor_inertia;
  SM_ELEMENT_D(jacobian, 1, 3) = load_rate - motor_rate;
  SM_ELEMENT_D(jacobian, 2, 3) = 1.0;
  SM_ELEMENT_D(jacobian, 3, 3) = -load_rate;
  return 0;
}

/// Distances to the other face and to the one just left.
int gap_roots(realtype, N_Vector state, realtype* values, void* data) {
  const Problem& problem = problem_of(data);
  const double displacement = problem.face * NV_DATA_S(state)[0];
  values[0] = problem.servo.backlash + displacement;
  values[1] = problem.near_face_margin - displacement;
  return 0;
}

/// CVODE looks for a sign change after its first step only; a bounce that begins and ends within it
/// would be missed. A tenth of a bounce from a state with relative speed, else 0.
double bounce_fraction(const Coefficients& servo, const GapState4& state) {
  if (state[1] == 0.0) return 0.0;
  const double acceleration =
      servo.motor_acceleration(state[2], state[3] + state[1]) - servo.load_acceleration(state[3]);
  return state[1] * acceleration < 0.0 ? 0.2 * std::abs(state[1] / acceleration) : 0.0;
}

void require(bool sound, const char* call) {
  if (!sound) throw std::runtime_error(std::string("CVODE failed in ") + call);
}

}  // namespace

/// One mode's solver with all its memory.
class CvodeRival::Solver {
 public:
  struct Mode {
    int size;
    CVRhsFn derivative;
    CVLsJacFn jacobian;
    CVRootFn roots;
  };

  Solver(const NormalizedServo& servo, CvodeMethod method, const Mode& mode)
      : problem_{Coefficients(servo)} {
    require(SUNContext_Create(nullptr, &context_) == 0, "SUNContext_Create");
    state_ = N_VNew_Serial(mode.size, context_);
    memory_ = CVodeCreate(method == CvodeMethod::bdf ? CV_BDF : CV_ADAMS, context_);
    require(state_ != nullptr && memory_ != nullptr, "CVodeCreate");
    N_VConst(0.0, state_);
    require(CVodeInit(memory_, mode.derivative, 0.0, state_) == CV_SUCCESS, "CVodeInit");
    require(CVodeSStolerances(memory_, rival_tolerance, rival_tolerance) == CV_SUCCESS,
            "CVodeSStolerances");
    require(CVodeSetUserData(memory_, &problem_) == CV_SUCCESS, "CVodeSetUserData");
    require(CVodeSetMaxNumSteps(memory_, 1'000'000) == CV_SUCCESS, "CVodeSetMaxNumSteps");
    if (method == CvodeMethod::bdf) {
      matrix_ = SUNDenseMatrix(mode.size, mode.size, context_);
      linear_ = SUNLinSol_Dense(state_, matrix_, context_);
      require(CVodeSetLinearSolver(memory_, linear_, matrix_) == CV_SUCCESS,
              "CVodeSetLinearSolver");
      require(CVodeSetJacFn(memory_, mode.jacobian) == CV_SUCCESS, "CVodeSetJacFn");
    } else {
      nonlinear_ = SUNNonlinSol_FixedPoint(state_, 0, context_);
      require(CVodeSetNonlinearSolver(memory_, nonlinear_) == CV_SUCCESS,
              "CVodeSetNonlinearSolver");
    }
    require(CVodeRootInit(memory_, 2, mode.roots) == CV_SUCCESS, "CVodeRootInit");
    require(CVodeSetNoInactiveRootWarn(memory_) == CV_SUCCESS, "CVodeSetNoInactiveRootWarn");
  }

  ~Solver() {
    if (memory_ != nullptr) CVodeFree(&memory_);
    if (nonlinear_ != nullptr) SUNNonlinSolFree(nonlinear_);
    if (linear_ != nullptr) SUNLinSolFree(linear_);
    if (matrix_ != nullptr) SUNMatDestroy(matrix_);
    if (state_ != nullptr) N_VDestroy(state_);
    SUNContext_Free(&context_);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  void watch_directions(int first, int second) {
    int directions[2] = {first, second};
    require(CVodeSetRootDirection(memory_, directions) == CV_SUCCESS, "CVodeSetRootDirection");
  }

  void leave_margin(double margin) { problem_.near_face_margin = margin; }

  /// 0: CVODE chooses.
  void first_step(double step) {
    require(CVodeSetInitStep(memory_, step) == CV_SUCCESS, "CVodeSetInitStep");
  }

  template <class State>
  void begin(double time, const State& state, double face) {
    problem_.face = face;
    std::copy(state.begin(), state.end(), NV_DATA_S(state_));
    require(CVodeReInit(memory_, time, state_) == CV_SUCCESS, "CVodeReInit");
  }

  /// Runs on to the next root; which of the two it was, or −1 when `end` came first.
  int next_root(double end, double& time) {
    const int flag = CVode(memory_, end, state_, &time, CV_NORMAL);
    require(flag >= 0, "CVode");
    if (flag != CV_ROOT_RETURN) return -1;
    int found[2];
    require(CVodeGetRootInfo(memory_, found) == CV_SUCCESS, "CVodeGetRootInfo");
    return found[0] != 0 ? 0 : 1;
  }

  template <class State>
  void read(State& state) const {
    std::copy_n(NV_DATA_S(state_), state.size(), state.begin());
  }
  double component(int i) const { return NV_DATA_S(state_)[i]; }

 private:
  Problem problem_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  SUNNonlinearSolver nonlinear_ = nullptr;
};

CvodeRival::CvodeRival(const NormalizedServo& servo, CvodeMethod method)
    : engaged_(std::make_unique<Solver>(
          servo, method, Solver::Mode{2, engaged_derivative, engaged_jacobian, engaged_roots})),
      gap_(std::make_unique<Solver>(servo, method,
                                    Solver::Mode{4, gap_derivative, gap_jacobian, gap_roots})),
      servo_(servo) {
  engaged_->watch_directions(-1, 0);
  gap_->watch_directions(-1, -1);
}

CvodeRival::~CvodeRival() = default;
CvodeRival::CvodeRival(CvodeRival&&) noexcept = default;

double CvodeRival::follow_engagement(double& time, EngagedState& state, double face) {
  constexpr double longest = 1e3;
  const double end = time + longest;
  double turning = 0.0;
  engaged_->begin(time, state, face);
  while (true) {
    const int root = engaged_->next_root(end, time);
    if (root == 1) {
      turning = std::max(turning, std::abs(engaged_->component(0)));
      continue;
    }
    engaged_->read(state);
    return turning;
  }
}

double CvodeRival::follow_gap(double& time, GapState4& state, double face) {
  constexpr double longest = 1e3;
  gap_->leave_margin(near_face_margin(state));
  gap_->first_step(bounce_fraction(servo_, state));
  gap_->begin(time, state, face);
  const int root = gap_->next_root(time + longest, time);
  gap_->read(state);
  if (root < 0) return 0.0;
  return root == 0 ? -face : face;
}

}  // namespace gearlash::benchmarks
