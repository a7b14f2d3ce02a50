/// Whatever ends a run, a kill at any instant or any call to the disk that fails, `--restart
/// latest` goes on from the latest checkpoint that was reported, to the bits of the run that never
/// ended.

#include "common/base/error.hpp"
#include "common/io/sealed_file.hpp"
#include "tests/command_line/small_case.hpp"
#include "tests/folders.hpp"
#include "tests/trials.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <random>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::Folder;
using tests::Outcome;
using tests::shell;
using tests::summary_in;
using tests::text_of;
using tests::Trials;

const std::string command = "$diptych run case.toml --threads 1 --quiet --method fvm --out ";

class Crash : public testing::Test {
 protected:
  explicit Crash(const std::string& times) {
    folder.write("case.toml", tests::cube + times + tests::probes);
    const Outcome whole = shell(folder, command + "whole");
    EXPECT_EQ(whole.exit_code, 0) << whole.text;
    wanted = summary_in(folder.path() / "whole/fvm");
    history = text_of(folder.path() / "whole/fvm/history.csv");
  }
  fs::path out() const { return folder.path() / "out/fvm"; }
  /// Step of the latest checkpoint that stands in the folder; 0: none.
  std::int64_t latest() const {
    std::int64_t latest = 0;
    if (!fs::exists(out())) return latest;
    for (const auto& entry : fs::directory_iterator(out())) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("checkpoint_") && name.ends_with(".hdf"))
        latest = std::max(latest, static_cast<std::int64_t>(std::stoll(name.substr(11, 8))));
    }
    return latest;
  }
  /// Goes on where the run ended, and compares what it leaves. @return whether all is well
  bool goes_on(const std::string& told) const {
    const std::int64_t step = latest();
    if (!fs::exists(out() / "summary.json")) return true;  // nothing had begun
    std::string again = command + "out";
    again.replace(again.find(" --quiet"), 8, "");
    again += step > 0 ? " --restart latest" : " --force";
    const Outcome outcome = shell(folder, again);
    const bool is_done = outcome.exit_code == 0;
    EXPECT_TRUE(is_done) << told << "\n" << outcome.text;
    if (!is_done) return false;
    if (step > 0 && wanted.steps > step) {
      EXPECT_THAT(outcome.text, HasSubstr(fmt::format("step {}, t =", step)))
          << told << ": not from the latest that was whole";
    }
    const bool is_same = summary_in(out()).state_hash == wanted.state_hash &&
                         text_of(out() / "history.csv") == history;
    EXPECT_TRUE(is_same) << told;
    const Outcome check = shell(folder, "$diptych check out");
    EXPECT_EQ(check.exit_code, 0) << told << "\n" << check.text;
    return is_same && check.exit_code == 0;
  }

  Folder folder;
  io::RunSummary wanted;
  std::string history;
};

class KilledRun : public Crash {
 protected:
  KilledRun() : Crash("[time]\nend = 0.05\n[output]\nframes = 5\n") {}
};

TEST_F(KilledRun, AtAnyInstantGoesOnFromTheLatestCheckpoint) {
  Trials trials("kills at random instants");
  std::mt19937 random(11);
  for (int trial = 0; trial < trials.n(6, 200); ++trial) {
    fs::remove_all(folder.path() / "out");
    const double instant = 0.02 + 1e-4 * static_cast<double>(random() % 6000);
    shell(folder,
          fmt::format("timeout -s KILL {} {}out --set time.checkpoint_every=1", instant, command));
    trials.add(goes_on(fmt::format("killed after {} s", instant)));
  }
}

class FailingDisk : public Crash {
 protected:
  FailingDisk() : Crash("[time]\nend = 1.2e-2\n[output]\nframes = 2\n") {}
  /// The run with its n-th call to the disk failing.
  Outcome run_failing(long at, const std::string& as, bool goes_on) const {
    return shell(folder,
                 fmt::format("timeout 60 env DIPTYCH_FAIL_COUNT={0}/count DIPTYCH_FAIL_AT={1} "
                             "DIPTYCH_FAIL_AS={2} DIPTYCH_FAIL_FROM={3} "
                             "LD_PRELOAD={4} {5}out --set "
                             "time.checkpoint_every=3",
                             folder.path().string(), at, as, goes_on ? 1 : 0,
                             tests::build_folder() + "/tests/libfailing_calls.so", command));
  }
  long n_calls() const { return std::stol(text_of(folder.path() / "count")); }
};

TEST_F(FailingDisk, LosesNothingThatWasReported) {
  ASSERT_EQ(run_failing(0, "5", false).exit_code, 0);
  const long n = n_calls();
  ASSERT_GT(n, 50);
  // twenty calls of each way, or every call
  const int n_steps = Trials::n(static_cast<int>(n / 20), 1);
  const std::vector<std::pair<std::string, std::string>> ways{{std::to_string(ENOSPC), "No space"},
                                                              {std::to_string(EIO), "Input/output"},
                                                              {std::to_string(EDQUOT), "quota"},
                                                              {"short", "No space"},
                                                              {"kill", ""}};
  Trials trials("calls to the disk that fail or kill");
  for (size_t way = 0; way < ways.size(); ++way) {
    for (long at = 1 + static_cast<long>(way) % n_steps; at <= n; at += n_steps) {
      const auto& [as, reason] = ways[way];
      const bool stays = as == std::to_string(ENOSPC);
      fs::remove_all(folder.path() / "out");
      const Outcome outcome = run_failing(at, as, stays);
      const std::string told = fmt::format("call {} of {} fails ({}): code {}\n{}", at, n, as,
                                           outcome.exit_code, outcome.text);
      bool is_good = outcome.exit_code == 4 || outcome.exit_code == 0 || as == "kill";
      EXPECT_TRUE(is_good) << told;
      if (outcome.exit_code == 4) {
        is_good = outcome.text.find(reason) != std::string::npos &&
                  outcome.text.find("out") != std::string::npos;
        EXPECT_TRUE(is_good) << told << "\nneither path nor reason";
      }
      if (outcome.exit_code == 0) {  // what failed was of no account, or was tried again
        is_good = summary_in(out()).state_hash == wanted.state_hash &&
                  shell(folder, "$diptych check out").exit_code == 0;
        EXPECT_TRUE(is_good) << told;
      } else {
        is_good = goes_on(told) && is_good;
      }
      trials.add(is_good);
    }
  }
}

class DamagedFile : public Crash {
 protected:
  DamagedFile() : Crash("[time]\nend = 1.2e-2\n[output]\nframes = 2\n") {}
};

TEST_F(DamagedFile, IsRefusedWhereverTheDamageIs) {
  ASSERT_EQ(shell(folder, command + "out --set time.checkpoint_every=1000").exit_code, 0);
  Trials trials("damaged files");
  std::mt19937 random(3);
  const size_t block = 4096;
  for (const auto& entry : fs::directory_iterator(out())) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".hdf")) continue;
    const std::string whole = text_of(entry.path());
    const std::string damaged = (folder.path() / "damaged.hdf").string();
    const auto is_refused = [&](const std::string& bytes) {
      std::ofstream(damaged, std::ios::binary) << bytes;
      try {
        io::read_sealed_file(damaged);
      } catch (const base::InputError&) {
        return true;
      }
      return false;
    };
    EXPECT_FALSE(is_refused(whole)) << name;
    for (size_t begin = 0; begin < whole.size(); begin += block) {
      for (int k = 0; k < Trials::n(1, 8); ++k) {
        std::string flipped = whole;
        const size_t at = begin + random() % std::min(block, whole.size() - begin);
        flipped[at] = static_cast<char>(flipped[at] ^ (1 << random() % 8));
        const bool is_good = is_refused(flipped);
        EXPECT_TRUE(is_good) << name << ", byte " << at;
        trials.add(is_good);
      }
      const bool is_good = is_refused(whole.substr(0, begin));
      EXPECT_TRUE(is_good) << name << " of " << begin << " bytes";
      trials.add(is_good);
    }
  }
}

TEST_F(DamagedFile, OfARecordIsNamedByCheck) {
  ASSERT_EQ(shell(folder, command + "out --set time.checkpoint_every=10").exit_code, 0);
  const Outcome whole = shell(folder, "$diptych check out");
  EXPECT_EQ(whole.exit_code, 0) << whole.text;
  EXPECT_THAT(whole.text, HasSubstr("3 rows, 3 frames, 2 checkpoints: whole"));
  Trials trials("damaged records");
  for (const auto& entry : fs::directory_iterator(out())) {
    const std::string bytes = text_of(entry.path());
    for (const bool is_cut : {false, true}) {
      std::string damaged = bytes;
      if (is_cut) {
        damaged.resize(damaged.size() / 2);
      } else {
        damaged[damaged.size() / 2] ^= 1;
      }
      std::ofstream(entry.path(), std::ios::binary) << damaged;
      const Outcome check = shell(folder, "$diptych check out");
      const std::string name = entry.path().filename().string();
      const bool is_good = check.exit_code == 2 && check.text.find(name) != std::string::npos;
      EXPECT_TRUE(is_good) << name << (is_cut ? ", cut off" : ", flipped") << "\n" << check.text;
      trials.add(is_good);
    }
    std::ofstream(entry.path(), std::ios::binary) << bytes;
  }
  EXPECT_EQ(shell(folder, "$diptych check out").exit_code, 0);
}

TEST_F(DamagedFile, LockedAndFinishedFoldersAreKept) {
  ASSERT_EQ(shell(folder, command + "out").exit_code, 0);
  const Outcome again = shell(folder, command + "out");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.text,
              HasSubstr("out/fvm: is a run that finished; give another --out, or --force"));
  EXPECT_EQ(shell(folder, command + "out --force").exit_code, 0);
  const Outcome two =
      shell(folder,
            "$diptych run case.toml --method fvm --quiet --out two --set "
            "time.end=50 --set output.frames=5000 & first=$!\n"
            "for i in $(seq 100); do [ -e two/fvm/summary.json ] && break; sleep "
            "0.05; done\n" +
                command + "two; echo code $?\n$diptych check two\nkill -INT $first; wait");
  EXPECT_THAT(two.text, HasSubstr("writes there; wait for its end, or give another --out"));
  EXPECT_THAT(two.text, HasSubstr("code 2"));
  EXPECT_THAT(two.text, HasSubstr("two: process "));
  EXPECT_FALSE(fs::exists(folder.path() / "two/diptych.lock"));
}

}  // namespace
}  // namespace diptych
