/// Menus asked by name, and the exit codes that errors carry.

#include "common/base/registry.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace {

using diptych::base::BoundError;
using diptych::base::BreakdownError;
using diptych::base::EnvironmentError;
using diptych::base::Error;
using diptych::base::ExitCode;
using diptych::base::InputError;
using diptych::base::Registry;

Registry<int> kernels() {
  Registry<int> menu("kernel");
  menu.add("cubic", 3).add("quintic", 5).add("wendland", 2);
  return menu;
}

/// Message and exit code of the error that asking for `name` raises.
std::string message_of(const std::string& name) {
  try {
    kernels().at(name);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::wrong_input);
    return error.what();
  }
  return "no error";
}

TEST(Registry, AnswersByNameAndKeepsTheOrderOfRegistration) {
  EXPECT_EQ(kernels().at("cubic"), 3);
  EXPECT_EQ(kernels().at("wendland"), 2);
  EXPECT_EQ(kernels().names(), (std::vector<std::string>{"cubic", "quintic", "wendland"}));
}

TEST(Registry, AWrongNameAnswersWithTheNearest) {
  EXPECT_EQ(message_of("quintc"), "unknown kernel 'quintc'; did you mean 'quintic'?");
}

TEST(Registry, AFarNameAnswersWithTheWholeMenu) {
  EXPECT_EQ(message_of("xyzzy"), "unknown kernel 'xyzzy'; known: cubic, quintic, wendland");
}

TEST(Registry, NamesAreExact) {
  // suggestions ignore the case, look-up does not: a key is one spelling
  EXPECT_EQ(message_of("Cubic"), "unknown kernel 'Cubic'; did you mean 'cubic'?");
}

TEST(Registry, ANameThatStandsTwiceIsAMistakeOfTheProgram) {
  Registry<int> menu = kernels();
  try {
    menu.add("quintic", 6);
    FAIL() << "the second entry could never be asked for";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "kernel 'quintic' stands twice in its menu");
  }
  EXPECT_EQ(menu.at("quintic"), 5);
  EXPECT_EQ(menu.names().size(), 3u);
}

TEST(Error, EachKindCarriesItsDocumentedExitCode) {
  EXPECT_EQ(static_cast<int>(InputError("x").code()), 2);
  EXPECT_EQ(static_cast<int>(BreakdownError("x").code()), 3);
  EXPECT_EQ(static_cast<int>(EnvironmentError("x").code()), 4);
  EXPECT_EQ(static_cast<int>(BoundError("x").code()), 5);
  EXPECT_EQ(static_cast<int>(ExitCode::interrupted), 130);
  EXPECT_STREQ(InputError("where and what").what(), "where and what");
}

}  // namespace
