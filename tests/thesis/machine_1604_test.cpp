// Each instruction of the CDC 1604, and the program of the thesis running on it.
#include "thesis/machine_1604.hpp"

#include <gtest/gtest.h>

#include "thesis/ar_assembler.hpp"
#include "thesis/listing.hpp"
#include "thesis/printout.hpp"
#include "thesis/thesis_machine.hpp"

namespace gearlash::thesis::machine_1604_test {
namespace {

/// Assembled at 100₈ and stepped `steps` times.
Machine1604 run(const std::string& program, int steps) {
  Machine1604 machine;
  for (const auto& [address, word] : assemble(read_program("\tORG\t\t100\n" + program)).words) {
    machine.write(address, word);
  }
  machine.jump(0100);
  for (int i = 0; i < steps; ++i) machine.step();
  return machine;
}

Word accumulator(const std::string& program, int steps) {
  return run(program, steps).registers().a;
}

TEST(Machine1604, EntersAndLoads) {
  EXPECT_EQ(accumulator("\tENA\t0\t5\n", 1), 5U);
  EXPECT_EQ(accumulator("\tENA\t0\t77776\n", 1), complement(1));  // the sign is extended
  EXPECT_EQ(accumulator("\tENA\t0\t5\n\tINA\t0\t77775\n", 2), 3U);
  EXPECT_EQ(accumulator("\tLDA\t0\tX\nX\tOCT\t\t1234567012345670\n", 1), 01234567012345670U);
  EXPECT_EQ(accumulator("\tLAC\t0\tX\nX\tOCT\t\t1\n", 1), complement(1));
  EXPECT_EQ(accumulator("\tLAC\t0\tX\nX\tOCT\t\t0\n", 1), word_bits);  // minus zero
}

TEST(Machine1604, AddsInOnesComplement) {
  EXPECT_EQ(accumulator("\tENA\t0\t7\n\tADD\t0\tX\nX\tDEC\t\t5\n", 2), 014U);
  EXPECT_EQ(accumulator("\tENA\t0\t7\n\tSUB\t0\tX\nX\tDEC\t\t9\n", 2), complement(2));
  EXPECT_EQ(accumulator("\tENA\t0\t7\n\tSUB\t0\tX\nX\tDEC\t\t7\n", 2), 0U);  // plus zero
  EXPECT_EQ(accumulator("\tENA\t0\t77776\n\tADD\t0\tX\nX\tDEC\t\t1\n", 2), 0U);
  EXPECT_EQ(accumulator("\tENA\t0\t77775\n\tADD\t0\tX\nX\tDEC\t\t5\n", 2), 3U);
}

TEST(Machine1604, StoresAndCounts) {
  const Machine1604 machine = run("\tENA\t0\t7\n\tSTA\t0\tX\n\tRAO\t0\tX\nX\tOCT\t\t0\n", 3);
  EXPECT_EQ(machine.read(0102), 010U);
  EXPECT_EQ(machine.registers().a, 010U);
}

TEST(Machine1604, Shifts) {
  EXPECT_EQ(accumulator("\tLDA\t0\tX\n\tALS\t0\t1\nX\tOCT\t\t2525252525252525\n", 2),
            05252525252525252U);
  EXPECT_EQ(accumulator("\tLDA\t0\tX\n\tALS\t0\t1\nX\tOCT\t\t5252525252525252\n", 2),
            02525252525252525U);  // around the end
  EXPECT_EQ(accumulator("\tENA\t0\t14\n\tARS\t0\t2\n", 2), 3U);
  EXPECT_EQ(accumulator("\tENA\t0\t77763\n\tARS\t0\t2\n", 2), complement(3));  // sign kept
}

TEST(Machine1604, FloatingPoint) {
  const auto of = [](const char* operation) {
    const std::string program =
        std::string("\tLDA\t0\tX\n\t") + operation + "\t0\tY\nX\tDEC\t\t.75\nY\tDEC\t\t.5\n";
    return Float1604::of(accumulator(program, 2)).value();
  };
  EXPECT_EQ(of("FAD"), 1.25);
  EXPECT_EQ(of("FSB"), 0.25);
  EXPECT_EQ(of("FMU"), 0.375);
  EXPECT_EQ(of("FDV"), 1.5);
}

TEST(Machine1604, JumpsOnTheAccumulator) {
  const auto taken = [](const char* condition, const char* value) {
    const std::string program = std::string("\tLDA\t0\tX\n\tAJP\t") + condition +
                                "\tFAR\nX\tOCT\t\t" + value + "\n\tORG\t\t200\nFAR\tENI\t0\t0\n";
    return run(program, 2).registers().p == 0200;
  };
  constexpr const char* positive = "1";
  constexpr const char* zero = "0";
  constexpr const char* negative = "7777777777777776";
  EXPECT_TRUE(taken("0", zero));
  EXPECT_FALSE(taken("0", positive));
  EXPECT_TRUE(taken("1", negative));
  EXPECT_FALSE(taken("1", zero));
  EXPECT_TRUE(taken("2", positive));
  EXPECT_TRUE(taken("2", zero));
  EXPECT_FALSE(taken("2", negative));
  EXPECT_TRUE(taken("3", negative));
  EXPECT_FALSE(taken("3", zero));
}

TEST(Machine1604, ReturnJumpLeavesTheAddressAndEntersTheLowerHalf) {
  const Machine1604 machine = run(
      "\tSLJ\t4\tSUB\n\tENA\t0\t1\n\tENA\t0\t2\nSUB\tSLJ\t0\t0\n\tENA\t0\t3\n\tSLJ\t0\tSUB\n", 5);
  // After ENA 3 and two jumps it goes on at the word after the return jump's.
  EXPECT_EQ(machine.registers().a, 2U);
  EXPECT_EQ(upper_instruction(machine.read(0102)).operand, 0101U);
}

TEST(Machine1604, SkipsOnSign) {
  const std::string after = "\tENA\t0\t1\n\tENA\t0\t2\nX\tOCT\t\t";
  EXPECT_EQ(accumulator("\tSSK\t0\tX\n" + after + "1\n", 2), 1U);                 // half exit
  EXPECT_EQ(accumulator("\tSSK\t0\tX\n" + after + "7777777777777776\n", 2), 2U);  // full exit
}

TEST(Machine1604, IndexRegisters) {
  EXPECT_EQ(accumulator("\tENI\t1\t2\n\tLDA\t1\t100\n\tORG\t\t102\n\tOCT\t\t77\n", 2), 077U);
  EXPECT_EQ(run("\tENI\t3\t5\n\tINI\t3\t77776\n", 2).registers().index[3], 4U);
  EXPECT_EQ(run("\tENI\t0\t5\n", 1).registers().index[0], 0U);
  const Machine1604 loaded = run("\tLIU\t1\tX\n\tLIL\t2\tX\nX\tOCT\t\t0001234500054321\n", 2);
  EXPECT_EQ(loaded.registers().index[1], 012345U);
  EXPECT_EQ(loaded.registers().index[2], 054321U);
  const Machine1604 stored =
      run("\tENI\t1\t17\n\tSIU\t1\tX\n\tSIL\t1\tY\nX\tOCT\t\t0\nY\tOCT\t\t0\n", 3);
  EXPECT_EQ(stored.read(0102), 017U << 24U);
  EXPECT_EQ(stored.read(0103), 017U);
}

TEST(Machine1604, IndexJumpsAndSkips) {
  const Machine1604 more = run("\tENI\t1\t2\n\tIJP\t1\t200\n", 2);
  EXPECT_EQ(more.registers().p, 0200U);
  EXPECT_EQ(more.registers().index[1], 1U);
  EXPECT_EQ(run("\tENI\t1\t0\n\tIJP\t1\t200\n", 2).registers().p, 0101U);
  const Machine1604 reached = run("\tENI\t1\t3\n\tENI\t0\t0\n\tISK\t1\t3\n\tENA\t0\t1\n", 3);
  EXPECT_EQ(reached.registers().index[1], 0U);
  EXPECT_EQ(reached.registers().p, 0102U);
  const Machine1604 not_yet = run("\tENI\t1\t2\n\tENI\t0\t0\n\tISK\t1\t3\n\tENA\t0\t1\n", 3);
  EXPECT_EQ(not_yet.registers().index[1], 3U);
  EXPECT_TRUE(not_yet.registers().in_lower);
}

TEST(Machine1604, WhatIsNotKnownOfItIsAFault) {
  EXPECT_THROW(run("\t77\t0\t0\n", 1), MachineFault);
  EXPECT_THROW(run("\tSLJ\t1\t0\n", 1), MachineFault);               // jump keys
  EXPECT_THROW(run("\tLDA\t7\t0\n", 1), MachineFault);               // indirect
  EXPECT_THROW(run("\tENI\t0\t0\n\tSSK\t0\t0\n", 2), MachineFault);  // in the lower half
  try {
    run("\t77\t0\t0\n", 1);
  } catch (const MachineFault& fault) {
    EXPECT_STREQ(fault.what(),
                 "CDC 1604 at 00100, upper instruction: operation 77 is not provided");
  }
}

// ---- the listing and the program ----------------------------------------------------------------

TEST(OracleListing, AssemblesToItsOctalColumnButForTwoAddresses) {
  EXPECT_EQ(thesis_table_1().octal.size(), 171U);
  const auto differences = differences_of_listing();
  ASSERT_EQ(differences.size(), 2U);
  EXPECT_EQ(differences[0].address, 020103U);
  EXPECT_EQ(differences[0].source, "LDA 0 BKTEST2 | SUB 0 FACTOR2");
  EXPECT_EQ(differences[1].address, 020112U);
  EXPECT_EQ(differences[1].source, "LDA 0 BKTEST2 | ADD 0 FACTOR2");
  for (const ListingDifference& difference : differences) {
    EXPECT_EQ(lower_instruction(difference.listed).operand, 020172U);
    EXPECT_EQ(lower_instruction(difference.assembled).operand, 020167U);
  }
}

TEST(OracleThesisMachine, PrintsTableTwo) {
  ThesisMachine machine;
  int exact = 0;
  std::string other;
  for (const PrintedRow& printed : thesis_table_2()) {
    const PrintedRow row = printed_row(machine.next_line());
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (row[k] == printed[k]) {
        ++exact;
      } else {
        other += printed_text(row[k]) + " for " + printed_text(printed[k]);
      }
    }
  }
  EXPECT_EQ(exact, 189);
  EXPECT_EQ(other, "77040631- 1 for 77040630- 1");
}

TEST(OracleThesisMachine, IsThePortStepForStep) {
  // Many contacts on both faces: SWITCH has to work too.
  const ProgramParameters parameters = program_parameters(
      {.damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3});
  ThesisMachine machine;
  machine.set(parameters);
  const auto port = printout<Number1604<FloatRules{}>>(parameters, 1000);
  int contacts = 0;
  for (const PrintedLine& expected : port) {
    const PrintedLine line = machine.next_line();
    ASSERT_EQ(line.time, expected.time);
    ASSERT_EQ(line.motor_speed, expected.motor_speed);
    ASSERT_EQ(line.motor_position, expected.motor_position);
    ASSERT_EQ(line.load_speed, expected.load_speed);
    ASSERT_EQ(line.load_position, expected.load_position);
    ASSERT_EQ(line.at_contact, expected.at_contact);
    contacts += line.at_contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 20);
}

TEST(EdgeAssembler, NamesTheLineAtFault) {
  try {
    assemble(read_program("\tLDA\t0\tNOWHERE\n"));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "line 1: LDA 0 NOWHERE: the name NOWHERE is not defined");
  }
  EXPECT_THROW(assemble(read_program("\tXYZ\t0\t0\n")), std::invalid_argument);
  EXPECT_THROW(assemble(read_program("\tDEC\t\tabc\n")), std::invalid_argument);
}

}  // namespace
}  // namespace gearlash::thesis::machine_1604_test
