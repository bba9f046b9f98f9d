#include "drive_rival.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace gearlash::benchmarks {
namespace {

void require(bool sound, const char* call) {
  if (!sound) throw std::runtime_error(std::string("CVODE failed in ") + call);
}

enum class Faces { apart, pressed, letting_go };

struct Shaft {
  double inertia;
  double viscous;
  double dry;
  double way = 0.0;  ///< +1, −1, or 0: it sticks
};

/// The equations of motion in one way that things are.
struct Equations {
  Shaft motor;
  Shaft load;
  double half_gap;
  double stiffness;
  double damping;
  double torque = 0.0;
  Faces faces = Faces::apart;
  double side = 1.0;  ///< of the face, where not apart

  double depth(const double* z) const { return side * (z[0] - z[2]) - half_gap; }
  double pressure(const double* z) const {
    return stiffness * depth(z) + damping * side * (z[1] - z[3]);
  }
  double mesh(const double* z) const { return faces == Faces::pressed ? side * pressure(z) : 0.0; }
  double applied_to_motor(const double* z) const { return torque - mesh(z); }
  static double acceleration(const Shaft& shaft, double applied, double speed) {
    if (shaft.way == 0.0) return 0.0;
    return (applied - shaft.viscous * speed - shaft.way * shaft.dry) / shaft.inertia;
  }
  static double friction_root(const Shaft& shaft, double applied, double speed) {
    return shaft.way == 0.0 ? shaft.dry * shaft.dry - applied * applied : speed;
  }
};

const Equations& equations_of(void* data) { return *static_cast<const Equations*>(data); }

int derivative(realtype, N_Vector state, N_Vector rate, void* data) {
  const Equations& e = equations_of(data);
  const double* z = NV_DATA_S(state);
  double* r = NV_DATA_S(rate);
  r[0] = z[1];
  r[1] = Equations::acceleration(e.motor, e.applied_to_motor(z), z[1]);
  r[2] = z[3];
  r[3] = Equations::acceleration(e.load, e.mesh(z), z[3]);
  return 0;
}

int jacobian(realtype, N_Vector, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector,
             N_Vector) {
  const Equations& e = equations_of(data);
  SM_ELEMENT_D(matrix, 0, 1) = 1.0;
  SM_ELEMENT_D(matrix, 2, 3) = 1.0;
  const double stiffness = e.faces == Faces::pressed ? e.stiffness : 0.0;
  const double damping = e.faces == Faces::pressed ? e.damping : 0.0;
  const auto row = [&](const Shaft& shaft, int speed, double sign) {
    if (shaft.way == 0.0) return;
    SM_ELEMENT_D(matrix, speed, 0) = sign * stiffness / shaft.inertia;
    SM_ELEMENT_D(matrix, speed, 1) = sign * damping / shaft.inertia;
    SM_ELEMENT_D(matrix, speed, 2) = -sign * stiffness / shaft.inertia;
    SM_ELEMENT_D(matrix, speed, 3) = -sign * damping / shaft.inertia;
    SM_ELEMENT_D(matrix, speed, speed) -= shaft.viscous / shaft.inertia;
  };
  row(e.motor, 1, -1.0);
  row(e.load, 3, 1.0);
  return 0;
}

/// Of the faces (two) and of the friction on each shaft.
int roots(realtype, N_Vector state, realtype* values, void* data) {
  const Equations& e = equations_of(data);
  const double* z = NV_DATA_S(state);
  const double gap = z[0] - z[2];
  values[0] = e.faces == Faces::apart ? e.half_gap - gap : e.pressure(z);
  values[1] = e.faces == Faces::apart     ? e.half_gap + gap
              : e.faces == Faces::pressed ? 1.0
                                          : e.depth(z);
  values[2] = Equations::friction_root(e.motor, e.applied_to_motor(z), z[1]);
  values[3] = Equations::friction_root(e.load, e.mesh(z), z[3]);
  return 0;
}

}  // namespace

class CvodeDriveRival::Solver {
 public:
  Solver(const drive::ReducedDrive& drive, CvodeMethod method)
      : drive_(drive),
        law_(drive::sampled_controller(drive.controller, drive.sampling.value())),
        equations_(equations_of_drive(drive)) {
    require(SUNContext_Create(nullptr, &context_) == 0, "SUNContext_Create");
    state_ = N_VNew_Serial(4, context_);
    memory_ = CVodeCreate(method == CvodeMethod::bdf ? CV_BDF : CV_ADAMS, context_);
    require(state_ != nullptr && memory_ != nullptr, "CVodeCreate");
    N_VConst(0.0, state_);
    require(CVodeInit(memory_, derivative, 0.0, state_) == CV_SUCCESS, "CVodeInit");
    require(CVodeSStolerances(memory_, rival_tolerance, rival_tolerance) == CV_SUCCESS,
            "CVodeSStolerances");
    require(CVodeSetUserData(memory_, &equations_) == CV_SUCCESS, "CVodeSetUserData");
    require(CVodeSetMaxNumSteps(memory_, 1'000'000) == CV_SUCCESS, "CVodeSetMaxNumSteps");
    if (method == CvodeMethod::bdf) {
      matrix_ = SUNDenseMatrix(4, 4, context_);
      linear_ = SUNLinSol_Dense(state_, matrix_, context_);
      require(CVodeSetLinearSolver(memory_, linear_, matrix_) == CV_SUCCESS,
              "CVodeSetLinearSolver");
      require(CVodeSetJacFn(memory_, jacobian) == CV_SUCCESS, "CVodeSetJacFn");
    } else {
      nonlinear_ = SUNNonlinSol_FixedPoint(state_, 0, context_);
      require(CVodeSetNonlinearSolver(memory_, nonlinear_) == CV_SUCCESS,
              "CVodeSetNonlinearSolver");
    }
    require(CVodeRootInit(memory_, 4, roots) == CV_SUCCESS, "CVodeRootInit");
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

  std::array<double, 4> run(double until) {
    N_VConst(0.0, state_);
    equations_.faces = Faces::apart;
    equations_.motor.way = 0.0;
    equations_.load.way = 0.0;
    numbers_.assign(law_.order(), 0.0);
    const double period = drive_.sampling->period;
    double time = 0.0;
    for (int tick = 1; time < until; ++tick) {
      sample();
      follow(time, std::min(period * tick, until));
    }
    std::array<double, 4> end{};
    std::copy_n(NV_DATA_S(state_), end.size(), end.begin());
    return end;
  }

 private:
  static Equations equations_of_drive(const drive::ReducedDrive& drive) {
    const auto& contact = std::get<drive::CompliantContact>(drive.contact);
    const auto shaft = [](const drive::Shaft& s) {
      return Shaft{s.inertia, s.friction.viscous, s.friction.coulomb};
    };
    return {shaft(drive.motor), shaft(drive.load), 0.5 * drive.backlash, contact.stiffness,
            contact.damping};
  }

  /// The controller's law at a tick.
  void sample() {
    const double* z = NV_DATA_S(state_);
    const std::array<double, 3> inputs = {reference_, z[2], z[1]};
    double torque = 0.0;
    for (std::size_t i = 0; i < numbers_.size(); ++i) torque += law_.output[i] * numbers_[i];
    for (std::size_t i = 0; i < inputs.size(); ++i) torque += law_.direct[i] * inputs[i];
    std::vector<double> next(numbers_.size(), 0.0);
    for (std::size_t i = 0; i < next.size(); ++i) {
      for (std::size_t j = 0; j < next.size(); ++j)
        next[i] += law_.state_matrix[i][j] * numbers_[j];
      for (std::size_t j = 0; j < inputs.size(); ++j)
        next[i] += law_.input_matrix[i][j] * inputs[j];
    }
    numbers_ = next;
    equations_.torque = torque;
  }

  void follow(double& time, double end) {
    while (time < end) {
      loosen();
      require(CVodeReInit(memory_, time, state_) == CV_SUCCESS, "CVodeReInit");
      require(CVodeSetStopTime(memory_, end) == CV_SUCCESS, "CVodeSetStopTime");
      const int flag = CVode(memory_, end, state_, &time, CV_NORMAL);
      require(flag >= 0, "CVode");
      if (flag != CV_ROOT_RETURN) return;
      std::array<int, 4> found{};
      require(CVodeGetRootInfo(memory_, found.data()) == CV_SUCCESS, "CVodeGetRootInfo");
      change(found);
    }
  }

  void change(const std::array<int, 4>& found) {
    double* z = NV_DATA_S(state_);
    if (found[0] != 0 || found[1] != 0) change_faces(found);
    if (found[2] != 0 && equations_.motor.way != 0.0) stop(equations_.motor, z[1]);
    if (found[3] != 0 && equations_.load.way != 0.0) stop(equations_.load, z[3]);
    // What sticks and is about to be moved.
    if (found[2] != 0) release(equations_.motor, equations_.applied_to_motor(z));
    if (found[3] != 0) release(equations_.load, equations_.mesh(z));
  }

  void change_faces(const std::array<int, 4>& found) {
    Equations& e = equations_;
    if (e.faces == Faces::apart) {
      e.side = found[0] != 0 ? 1.0 : -1.0;
      e.faces = Faces::pressed;
    } else if (e.faces == Faces::pressed) {
      e.faces = Faces::letting_go;
    } else {
      e.faces = found[1] != 0 ? Faces::apart : Faces::pressed;
    }
  }

  static void stop(Shaft& shaft, double& speed) {
    speed = 0.0;
    shaft.way = 0.0;
  }

  /// At the root itself rounding decides whether it is exceeded: a little less counts too.
  static void release(Shaft& shaft, double applied) {
    constexpr double nearly = 1.0 - 1e-9;
    if (shaft.way == 0.0 && std::abs(applied) >= nearly * shaft.dry) {
      shaft.way = std::copysign(1.0, applied);
    }
  }

  /// What sticks and is moved at once: by a torque that has jumped.
  void loosen() {
    const double* z = NV_DATA_S(state_);
    const auto loosened = [](Shaft& shaft, double applied) {
      if (shaft.way == 0.0 && std::abs(applied) > shaft.dry) {
        shaft.way = std::copysign(1.0, applied);
      }
    };
    loosened(equations_.motor, equations_.applied_to_motor(z));
    loosened(equations_.load, equations_.mesh(z));
  }

  drive::ReducedDrive drive_;
  drive::LinearController law_;
  Equations equations_;
  double reference_ = std::get<double>(drive_.reference);
  std::vector<double> numbers_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  SUNNonlinearSolver nonlinear_ = nullptr;
};

CvodeDriveRival::CvodeDriveRival(const drive::ReducedDrive& drive, CvodeMethod method)
    : solver_(std::make_unique<Solver>(drive, method)) {}
CvodeDriveRival::~CvodeDriveRival() = default;
CvodeDriveRival::CvodeDriveRival(CvodeDriveRival&&) noexcept = default;

std::array<double, 4> CvodeDriveRival::run(double until) { return solver_->run(until); }

}  // namespace gearlash::benchmarks
