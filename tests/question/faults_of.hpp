// The faults that a call throws, a line each.
#pragma once

#include <string>
#include <vector>

#include "gearlash/fault.hpp"

namespace gearlash::test {

/// None where it does not throw InvalidInput.
template <class Call>
std::vector<std::string> faults_of(const Call& call) {
  std::vector<std::string> lines;
  try {
    call();
  } catch (const InvalidInput& error) {
    for (const Fault& fault : error.faults()) lines.push_back(to_string(fault));
  }
  return lines;
}

}  // namespace gearlash::test
