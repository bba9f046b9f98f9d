// Reads a drive, changes it by paths, and writes the drive and what it ends in.
#include <gearlash/gearlash.hpp>
#include <iostream>

int main(int argument_count, char** arguments) try {
  if (argument_count != 2) return std::cerr << "usage: change_file DRIVE.toml\n", 2;
  gearlash::Drive drive = gearlash::read_drive(arguments[1]);
  set(drive, "gearbox.backlash", "30 arcmin");
  set(drive, "controller.proportional", 1.5 * get(drive, "controller.proportional"));
  set(drive, "load.inertia", "40 kg cm2");
  const gearlash::Answer answer = analyse(drive);
  gearlash::save("changed.toml", to_toml(drive));
  gearlash::save("ends_in.json", to_json(drive, answer));
  std::cout << headline(drive, answer) << '\n';
} catch (const gearlash::InvalidInput& error) {
  return std::cerr << error.what() << '\n', 2;
}
