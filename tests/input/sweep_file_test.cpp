// Sweep files: what is varied, what is not, and every fault with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gearlash/input.hpp"
#include "question/faults_of.hpp"

namespace gearlash::sweep_file_test {
namespace {

using testing::ElementsAre;

std::vector<std::string> faults(const std::string& toml) {
  return test::faults_of([&] { parse_sweep(toml, "s.toml"); });
}

TEST(SweepFile, TheExampleIsRead) {
  const SweepFile file =
      read_sweep_file(std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "examples/sweep.toml");
  ASSERT_EQ(file.grid.axes.size(), 3U);
  EXPECT_EQ(file.grid.axes[0].path, "servo.damping");
  EXPECT_EQ(file.grid.size(), 56U * 97U * 101U);
  EXPECT_TRUE(file.grid.axes[2].logarithmic);
  EXPECT_EQ(file.grid.drive.servo->backlash, 0.3);
  EXPECT_THAT(file.quantities, ElementsAre(Quantity::growth_at_rest, Quantity::amplitude,
                                           Quantity::period, Quantity::multiplier));
}

TEST(SweepFile, WhatIsVariedNeedNotBeGiven) {
  const SweepFile file = parse_sweep(
      "[sweep]\naxes = ['damping=0.1,0.2', 'inertia-ratio=1,2', 'friction-ratio=0.1,0.2',\n"
      "'restitution=0,0.1', 'backlash=1 arcmin, 2 arcmin']\n",
      "s.toml");
  EXPECT_EQ(file.grid.size(), 32U);
  EXPECT_EQ(file.quantities.size(), 14U);  // all that the closed form knows
  const SweepFile in_backlashes = parse_sweep(
      "[sweep]\naxes = ['damping=0.1,0.2']\n[servo]\ninertia_ratio = 1\nfriction_ratio = '1/9'\n",
      "s.toml");
  EXPECT_EQ(in_backlashes.grid.drive.servo->backlash, 1.0);
  EXPECT_EQ(in_backlashes.grid.drive.servo->friction_ratio, 1.0 / 9.0);
  EXPECT_EQ(std::get<RigidContact>(in_backlashes.grid.drive.contact).restitution, 0.0);
}

TEST(SweepFile, HasAtMostABillionPoints) {
  const auto with_values = [](const std::string& count) {
    return "[sweep]\naxes = ['damping=0.1:0.6:1000', 'friction-ratio=0:1:1000', "
           "'inertia-ratio=1:2:" +
           count + "']\n";
  };
  EXPECT_EQ(parse_sweep(with_values("1000"), "s.toml").grid.size(), 1'000'000'000U);
  EXPECT_THAT(faults(with_values("1001")),
              ElementsAre(testing::HasSubstr("points = 1.001e+09: must be at most 1e+09")));
}

TEST(SweepFile, AnyDriveIsSwept) {
  const SweepFile file = parse_sweep(
      "[sweep]\naxes = ['backlash = 1 arcmin:10 arcmin:4', 'controller.proportional=1,2']\n"
      "[motor]\nkind = 'torque-controlled'\ninertia = '1 kg cm2'\nfriction = '1 mN m s/rad'\n"
      "[gearbox]\nratio = 20\n[load]\ninertia = '0.05 kg m2'\nfriction = '0.05 N m s/rad'\n"
      "[controller]\nkind = 'P'\n",
      "s.toml");
  ASSERT_EQ(file.grid.axes.size(), 2U);
  EXPECT_EQ(file.grid.axes[0].path, "gearbox.backlash");
  EXPECT_EQ(file.grid.axes[1].values, (std::vector<double>{1.0, 2.0}));
}

TEST(SweepFile, FaultsAreToldWithTheirPlaces) {
  EXPECT_THAT(faults("[servo]\ndamping = 1\n"),
              ElementsAre("s.toml:1:1: sweep is missing: must be a section [sweep] with axes"));
  EXPECT_THAT(
      faults("[sweep]\naxes = []\nspeed = 1\n"),
      ElementsAre("s.toml:2:8: sweep.axes = []: must be a list of texts: [\"…\", \"…\"]",
                  "s.toml:3:1: sweep.speed = 1: is not a key of [sweep]: must be one of axes, "
                  "quantities, verdicts"));
  EXPECT_THAT(
      faults("[sweep]\naxes = ['damping=0.1,0.2']\n[servo]\ninertia_ratio = 1\n"
             "friction_ratio=1\n[contact]\nrestitution = 2\n[gearbox]\n"),
      ElementsAre("s.toml:7:15: contact.restitution = 2: must be from 0 to 1",
                  "s.toml:8:1: gearbox = [gearbox]: must not stand beside [servo], which is "
                  "normalised"));
  EXPECT_THAT(
      faults("[sweep]\naxes = ['restitution=0,0.1']\n[servo]\ndamping = 0.1\n"
             "inertia_ratio = 1\nfriction_ratio=1\n[contact]\nrestitution = 0.5\n"),
      ElementsAre("s.toml:8:15: contact.restitution = 0.5: must be left out: [sweep] varies "
                  "it"));
  EXPECT_THAT(
      faults("[sweep]\naxes = ['damping=0.1,0.2', 'inertia_ratio=1,2', "
             "'friction_ratio=0,1', 'backlash=1,2', 'restitution=0,1', 'damping=1,2', "
             "'damping=3,4']\n"),
      ElementsAre(testing::HasSubstr("sweep.axes[6] = damping=3,4: must be at most 6 axes")));
}

TEST(SweepFile, EveryFaultIsTold) {
  const auto expect_faults = [](const std::string& toml, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      EXPECT_THAT(faults(toml), testing::Contains(testing::HasSubstr(text)));
    }
  };
  expect_faults(
      "[sweep]\n"
      "axes = ['damping=0.6:0.1:5', 'weight=1:2:3', 'friction-ratio=0:1:1000000000000',\n"
      "        'inertia-ratio=0:1:5:log', 'backlash=', 3]\n"
      "quantities = ['amplitudes']\n",
      {"s.toml:2:9: sweep.axes[0] = damping=0.6:0.1:5: must rise",
       "s.toml:2:30: sweep.axes[1] = weight=1:2:3: must be a number or a choice",
       "sweep.axes[2] = friction-ratio=0:1:1000000000000: must be from 1 to 1000000",
       "sweep.axes[3] = inertia-ratio=0:1:5:log: must be positive",
       "sweep.axes[4] = backlash=: must be PATH=", "sweep.axes[5] = 3: must be a text",
       "sweep.quantities[0] = amplitudes: must be one of growth_at_rest, amplitude",
       "(did you mean amplitude?)"});
  expect_faults(
      "[sweep]\naxes = ['damping=0.1:0.6:5', 'damping=0.7:0.8:5']\n"
      "[servo]\ndamping = 0.1\ninertia_ratio = 1\n",
      {"sweep.axes[1] = damping=0.7:0.8:5: must be another parameter than that of sweep.axes[0]",
       "servo.damping = 0.1: must be left out: [sweep] varies it",
       "servo.friction_ratio is missing: must be from 0 to 1"});
}

}  // namespace
}  // namespace gearlash::sweep_file_test
