/// Every call with which a file is written, failing: the message names path and errno, and what was
/// there before is whole, or what was to be written is.

#include "common/base/error.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/checkpoint_file.hpp"
#include "common/io/checksums.hpp"
#include "common/io/field_writer.hpp"
#include "common/io/folder_lock.hpp"
#include "common/io/row_file.hpp"
#include "common/io/run_record.hpp"
#include "tests/command_line/failing_calls.hpp"
#include "tests/common/io/scratch.hpp"

#include <cerrno>
#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <map>
#include <optional>

namespace diptych::io {
namespace {

namespace fs = std::filesystem;
using test::Scratch;
using testing::HasSubstr;

/// What is advised for an errno.
const std::map<int, std::string> advice = {{ENOSPC, "free space or choose another folder"},
                                           {EROFS, "choose a folder that you may write to"},
                                           {ENOENT, "check that the folder exists"},
                                           {EIO, ""}};

/// The message of the error of the machine that writing ends with; nothing where it went well.
std::optional<std::string> failure_of(const std::function<void()>& write) {
  try {
    write();
  } catch (const base::EnvironmentError& error) {
    return error.what();
  }
  return std::nullopt;
}

/// Fails every call of `write`, one after the other. Where it goes on, all must be there.
/// @param is_whole  whether all that `write` writes is there
/// @param check     of a message: what else it says, what is there then
void fail_each_call(const std::function<void()>& prepare,
                    const std::function<void()>& write,
                    const std::function<bool()>& is_whole,
                    const std::function<void(int error, const std::string& message)>& check) {
  prepare();
  tests::fail_call(0);
  write();
  const long n = tests::n_calls_made();
  ASSERT_GT(n, 0);
  ASSERT_TRUE(is_whole());
  int n_told = 0;
  for (const auto& [error, words] : advice) {
    const std::string as = std::to_string(error);
    for (long k = 1; k <= n; ++k) {
      SCOPED_TRACE("call " + std::to_string(k) + ", errno " + as);
      tests::fail_call(0);
      prepare();
      tests::fail_call(k, as.c_str());
      const auto message = failure_of(write);
      tests::fail_call(0);
      if (!message) {
        EXPECT_TRUE(is_whole());
        continue;
      }
      ++n_told;
      // what is not there need not be removed: what that leaves fails later
      if (error != ENOENT) {
        EXPECT_THAT(*message, HasSubstr("(errno " + as + ")"));
      }
      check(error, *message);
    }
  }
  EXPECT_GE(n_told, n);  // of four times n
}

TEST(FailingDisk, AFileIsWholeWhateverFails) {
  const Scratch folder;
  const std::string path = folder / "file", text(100'000, 'x');
  fail_each_call([&] { write_file_atomically(path, "old"); },
                 [&] { write_file_atomically(path, text); },
                 [&] { return read_file(path) == text; },
                 [&](int error, const std::string& message) {
                   EXPECT_THAT(message, HasSubstr("'" + path + "'"));
                   EXPECT_THAT(message, HasSubstr(advice.at(error)));
                   const std::string now = read_file(path);
                   EXPECT_TRUE(now == "old" || now == text);
                 });
}

TEST(FailingDisk, AnInterruptedOrHalfWriteGoesOn) {
  const Scratch folder;
  const std::string text(100'000, 'x');
  const auto write_rows = [&] {
    RowFile rows(folder / "rows", "a\n");
    rows.append(text);
    rows.finish();
  };
  const std::string interrupted = std::to_string(EINTR);
  for (const std::string& as : {interrupted, std::string("short")}) {
    int n_good = 0;
    for (long k = 1; k <= 12; ++k) {
      tests::fail_call(k, as.c_str());
      const bool is_file = !failure_of([&] { write_file_atomically(folder / "file", text); });
      tests::fail_call(k, as.c_str());
      const bool are_rows = !failure_of(write_rows);
      tests::fail_call(0);
      n_good += is_file + are_rows;
      if (is_file) {
        EXPECT_EQ(read_file(folder / "file"), text) << k;
      }
      if (are_rows) {
        EXPECT_EQ(read_file(folder / "rows"), "a\n" + text) << k;
      }
    }
    EXPECT_GT(n_good, 2) << as;
  }
}

TEST(FailingDisk, ALastWordIsWholeOrSaidToBeNone) {
  const Scratch folder;
  const std::string path = folder / "file";
  for (long k = 1; k <= 6; ++k) {
    for (const char* as : {"28", "4", "short"}) {
      tests::fail_call(0);
      write_file_atomically(path, "a long last word");
      tests::fail_call(k, as);
      const bool is_there = write_over(path, "short");
      tests::fail_call(0);
      if (is_there) {
        EXPECT_EQ(read_file(path), "short");
      }
    }
  }
  EXPECT_FALSE(write_over(folder / "none", "text"));
}

TEST(FailingDisk, RowsSayWhatFailed) {
  const Scratch folder;
  const std::string path = folder / "rows";
  fail_each_call([&] { write_file_atomically(path, "of an earlier run"); },
                 [&] {
                   RowFile rows(path, "a,b\n");
                   rows.append("1,2\n");
                   rows.finish();
                 },
                 [&] { return read_file(path) == "a,b\n1,2\n"; },
                 [&](int error, const std::string& message) {
                   EXPECT_THAT(message, HasSubstr("'" + path + "'"));
                   if (error == ENOSPC) {
                     EXPECT_THAT(message, HasSubstr(advice.at(error)));
                   }
                 });
}

TEST(FailingDisk, ACheckpointIsWholeOrNotThere) {
  const Scratch folder;
  const std::string path = folder / "checkpoint";
  const std::vector<double> quarters(20'000, 0.25);
  const auto is_whole = [&] {
    std::vector<double> values;
    CheckpointReader reader(path);
    static_cast<algebra::Archive&>(reader).reals("values", "m", values, 4);
    return values == quarters;
  };
  fail_each_call([&] { fs::remove(path); },
                 [&] {
                   std::vector<double> values = quarters;
                   CheckpointWriter writer(path);
                   static_cast<algebra::Archive&>(writer).reals("values", "m", values, 4);
                   writer.publish();
                 },
                 is_whole,
                 [&](int, const std::string& message) {
                   EXPECT_THAT(message, HasSubstr(path));
                   EXPECT_TRUE(!fs::exists(path) || is_whole());
                 });
}

TEST(FailingDisk, FramesAndTheirIndexSayWhatFailed) {
  VisualMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.connectivity = {0, 1, 2, 3};
  mesh.offsets = {0, 4};
  mesh.types = {10};
  const Scratch folder;
  const std::string frame = folder / "out/frame_0000.hdf";
  fail_each_call(
      [&] { fs::remove_all(folder / "out"); },
      [&] {
        FieldWriter writer(folder / "out", mesh);
        writer.write(0, [](std::int64_t, std::int64_t) {
          return std::vector<NodeField>{{"jacobian [-]", 1, {1, 1, 1, 1}}};
        });
      },
      [&] { return read_field(frame, "jacobian [-]").values.size() == 4; },
      [&](int, const std::string& message) { EXPECT_THAT(message, HasSubstr(folder / "out")); });
}

TEST(FailingDisk, ALockThatCannotBeWrittenIsNone) {
  const Scratch folder;
  fail_each_call([] {}, [&] { const FolderLock lock(folder.path()); },
                 [&] { return !lock_holder(folder.path()); },
                 [&](int, const std::string& message) {
                   EXPECT_THAT(message, HasSubstr("cannot lock"));
                   EXPECT_FALSE(lock_holder(folder.path()));
                 });
}

TEST(FailingDisk, ChecksumsThatCannotBeWrittenLeaveTheOldOnes) {
  const Scratch folder;
  write_file_atomically(folder / "a", "text");
  const auto is_whole = [&] { return changed_files(folder.path()).empty(); };
  fail_each_call([&] { write_checksums(folder.path(), {"a"}); },
                 [&] {
                   write_checksums(folder.path(), {"a", "not there"});
                 },
                 is_whole, [&](int, const std::string&) { EXPECT_TRUE(is_whole()); });
}

}  // namespace
}  // namespace diptych::io
