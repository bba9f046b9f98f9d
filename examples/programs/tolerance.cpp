// A production run: how many hunt, how large, and which tolerance decides it.
#include <cstdio>
#include <gearlash/tolerance.hpp>

int main() {
  using namespace gearlash;
  const TolerancedDrive drive{.nominal = normal_form(0.25, 2.0, 0.1, 0.3),
                              .varied = {{"servo.damping", within_share(0.25, 0.3)},
                                         {"servo.inertia_ratio", UniformBetween{1.5, 2.5}},
                                         {"servo.backlash", Normal{0.3, 0.03, 0.2, {}}}}};
  const ToleranceStudy study = study_tolerances(drive);
  std::printf("%.2f ± %.2f %% hunt\n", 100.0 * study.hunting.value,
              200.0 * study.hunting.standard_error.value());
  for (const auto& [share, amplitude] : study.amplitude) {
    std::printf("%2.0f %%: up to %.4f rad\n", 100.0 * share, amplitude.value().value);
  }
  for (const NumberSensitivity& number : study_sensitivities(drive).numbers) {
    std::printf("%s: %.2f of the amplitude's variance\n", number.path.c_str(),
                number.of_amplitude.value().total.value);
  }
}
