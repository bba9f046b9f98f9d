#include "input/foreign_words.hpp"

#include "base/lists.hpp"
#include "gearlash/units.hpp"
#include "input/parameter_text.hpp"
#include "input/robot_form.hpp"
#include "input/section_reader.hpp"

namespace gearlash {
namespace {

/// "Max-Current" is "max_current".
std::string plain(std::string_view word) {
  std::string text(word);
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '-' || c == ' ' || c == '.') c = '_';
  }
  return text;
}

std::string key_of(std::string_view path) {
  const std::size_t point = path.find('.');
  return std::string(point == std::string_view::npos ? path : path.substr(point + 1));
}

/// The paths of the parameters that others call so.
std::vector<std::string> paths_of_word(std::string_view key) {
  std::vector<std::string> paths;
  for (const ForeignWords& foreign : all_foreign_words()) {
    if (contains(split(foreign.words, " "), plain(key))) paths.emplace_back(foreign.path);
  }
  return paths;
}

/// The paths of all names with that key, in whatever case, one for each section.
std::vector<std::string> paths_with_key(std::string_view key) {
  std::vector<std::string> paths;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    for (const std::string_view path : paths_of(parameter)) {
      const bool is_new = !any_of(
          paths, [&](const std::string& other) { return section_of(other) == section_of(path); });
      if (is_new && plain(key_of(path)) == plain(key)) paths.emplace_back(path);
    }
  }
  return paths;
}

/// Those of the section, if there are any, by their keys alone.
std::vector<std::string> nearer(const std::vector<std::string>& paths, std::string_view section) {
  std::vector<std::string> own;
  for (const std::string& path : paths) {
    if (section_of(path) == section) own.push_back(key_of(path));
  }
  return own.empty() ? paths : own;
}

/// Those of a drive as it is built, without the normal form's and robots', if there are any.
std::vector<std::string> of_plants(const std::vector<std::string>& paths) {
  const auto built = those_of(paths, [](const std::string& path) {
    return section_of(path) != "servo" && !is_of_robots(section_of(path));
  });
  return built.empty() ? paths : built;
}

std::string question(const std::vector<std::string>& names) {
  return names.empty() ? "" : " (did you mean " + alternatives(names) + "?)";
}

}  // namespace

const std::vector<ForeignWords>& all_foreign_words() {
  static const std::vector<ForeignWords> all = {
      {"motor.inertia", "rotor_inertia motor_inertia inertia_rotor armature jm j_m j p0341"},
      {"motor.friction", "damping viscous_friction viscous_damping viscous b"},
      {"motor.coulomb", "friction_torque frictionloss dry_friction coulomb_friction tau_c"},
      {"motor.breakaway", "static_friction stiction breakaway_torque starting_torque"},
      {"motor.torque_constant", "kt k_t km k_m torque_const kn p0316 motor_kt"},
      {"motor.back_emf_constant", "ke k_e kb emf_constant back_emf bemf voltage_constant"},
      {"motor.speed_constant", "kv_rating velocity_constant"},
      {"motor.resistance",
       "terminal_resistance phase_resistance armature_resistance winding_resistance r ra"},
      {"motor.inductance", "terminal_inductance phase_inductance rotor_inductance l la"},
      {"motor.current_limit",
       "max_current maximum_current peak_current i_max imax max_continuous_current rated_current "
       "nominal_current stall_current current_lim current_max servo_max_current_a p0640 il_limitp"},
      {"motor.torque_limit",
       "max_torque maximum_torque peak_torque stall_torque rated_torque nominal_torque torque_max "
       "effort max_effort effort_limit forcerange ctrlrange actuatorfrcrange torque_lim p1520"},
      {"motor.voltage_limit",
       "max_voltage supply_voltage nominal_voltage rated_voltage bus_voltage vbus voltage "
       "voltage_power_supply"},
      {"gearbox.ratio",
       "gear_ratio reduction reduction_ratio mechanical_reduction mechanicalreduction gear "
       "transmission_ratio n"},
      {"gearbox.backlash",
       "play lost_motion lash hysteresis_loss free_play max_backlash gear_play "
       "average_backlash md32450"},
      {"gearbox.inertia", "mass_inertia gear_inertia gearbox_inertia"},
      {"gearbox.torsional_stiffness",
       "stiffness torsional_rigidity torsion_stiffness spring_constant spring_rate "
       "tilting_rigidity"},
      {"load.inertia", "load_inertia inertia_load jl j_l j ixx iyy izz moment_of_inertia"},
      {"load.friction", "damping viscous_friction viscous_damping viscous b"},
      {"load.coulomb", "friction_torque frictionloss dry_friction coulomb_friction tau_c"},
      {"load.breakaway", "static_friction stiction breakaway_torque starting_torque"},
      {"load.gravity", "weight payload gravity_torque mgl mass"},
      {"sensor.counts_per_turn",
       "cpr counts_per_rev counts_per_revolution encoder_cpr encoder_counts encoder_resolution "
       "increments ticks_per_rev steps_per_rev"},
      {"sensor.lines",
       "ppr pulses_per_rev pulses_per_revolution pulses_per_turn encoder_lines line_count "
       "encoder_pulses encoder_resolution p0408"},
      {"sensor.bits", "encoder_bits resolution_bits encoder_resolution"},
      {"controller.proportional",
       "p p_gain kp_gain gain_p pid_p servo_pid_position_kp p_coefficient"},
      {"controller.integral", "i i_gain gain_i pid_i servo_pid_position_ki i_coefficient"},
      {"controller.derivative", "d d_gain gain_d pid_d servo_pid_position_kd d_coefficient"},
      {"controller.position",
       "position_gain position_loop_gain kpp kv_factor pl_kp p2538 posctrl_gain md32200 s_0_0104 "
       "pn102"},
      {"controller.speed",
       "speed_gain velocity_gain speed_loop_gain vp kvp vl_kp p1460 "
       "speedctrl_gain_1 md1407 s_0_0100 pn100"},
      {"controller.speed_integral",
       "velocity_integral speed_ki kvi vl_ki velocity_integrator_gain"},
      {"controller.Tn",
       "integral_time reset_time integrator_time integral_action_time p1462 "
       "speedctrl_integrator_time_1 md1409 s_0_0101 pn101 vl_tn"},
      {"controller.Tv", "derivative_time rate_time"},
      {"controller.tracking_time",
       "anti_windup antiwindup i_clamp i_max ilimit windup integral_limit"},
      {"controller.filter", "lpf filter_time derivative_filter speed_filter velocity_filter t1 tf"},
      {"controller.dead_band", "deadband deadzone dead_zone position_deadband"},
      {"controller.pos_gain", "axis0_controller_config_pos_gain controller_config_pos_gain"},
      {"controller.vel_gain", "axis0_controller_config_vel_gain controller_config_vel_gain"},
      {"controller.vel_integrator_gain",
       "axis0_controller_config_vel_integrator_gain "
       "controller_config_vel_integrator_gain"},
      {"controller.pid_position_kp", "servo_pid_position_kp"},
      {"controller.pid_position_ki", "servo_pid_position_ki"},
      {"controller.pid_position_kd", "servo_pid_position_kd"},
      {"controller.rotor_to_output_ratio", "motor_position_rotor_to_output_ratio"},
      {"controller.P_angle", "p_angle_p"},
      {"controller.PID_velocity_P", "pid_velocity_p"},
      {"sampling.period", "cycle_time sample_time sampling_time dt ts loop_time timestep"},
      {"sampling.rate", "sample_rate sampling_rate update_rate control_frequency loop_rate fs"},
      {"sampling.delay", "latency dead_time computation_delay"}};
  return all;
}

std::string guess_of_key(std::string_view section, std::string_view key,
                         const std::vector<std::string>& known) {
  if (section == "servo") return guess_of(known, key);
  std::vector<std::string> paths = paths_with_key(key);
  const std::vector<std::string> foreign = paths_of_word(key);
  const bool is_of_section =
      any_of(foreign, [&](const std::string& path) { return section_of(path) == section; });
  if (paths.empty() || is_of_section) paths = foreign;
  return paths.empty() ? guess_of(known, key) : question(nearer(of_plants(paths), section));
}

std::string guess_of_path(std::string_view path, const std::vector<std::string>& known) {
  const bool has_section = path.find('.') != std::string_view::npos;
  const std::string section(has_section ? section_of(path) : "");
  const std::string key = key_of(path);
  std::vector<std::string> names = paths_with_key(key);
  add_all(names, paths_of_word(key));
  names = those_of(names, [&](const std::string& name) { return contains(known, name); });
  const auto own =
      those_of(names, [&](const std::string& name) { return section_of(name) == section; });
  if (!names.empty()) return question(own.empty() ? of_plants(names) : own);
  const std::string guess = guess_of(known, path);
  if (!guess.empty() || has_section) return guess;
  const auto near = nearest(of_each(known, key_of), path);
  return near ? question(paths_with_key(*near)) : "";
}

}  // namespace gearlash
