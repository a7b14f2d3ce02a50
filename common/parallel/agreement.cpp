#include "common/parallel/agreement.hpp"

#include "common/base/error.hpp"

#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace diptych::parallel {

namespace {

/// How a rank has fared.
struct Outcome {
  base::ExitCode code = base::ExitCode::done;
  char message[1024] = {};
};

Outcome outcome_of(const std::exception_ptr& error) {
  Outcome outcome;
  if (!error) return outcome;
  const auto tell = [&](base::ExitCode code, const char* message) {
    outcome.code = code;
    std::strncpy(outcome.message, message, sizeof outcome.message - 1);
  };
  try {
    std::rethrow_exception(error);
  } catch (const base::Error& thrown) {
    tell(thrown.code(), thrown.what());
  } catch (const std::bad_alloc&) {
    tell(base::ExitCode::environment, "out of memory");
  } catch (const std::exception& thrown) {
    tell(base::ExitCode::environment, thrown.what());
  }
  return outcome;
}

}  // namespace

void agree(Communicator& ranks, const std::exception_ptr& error) {
  std::vector<Outcome> all(static_cast<size_t>(ranks.size()));
  all[ranks.rank()] = outcome_of(error);
  const std::vector<std::int64_t> bytes(all.size(), sizeof(Outcome));
  ranks.all_gather(bytes_of(all.data()), bytes);
  if (error) std::rethrow_exception(error);
  for (size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank].code == base::ExitCode::done) continue;
    throw base::Error(all[rank].code, "rank " + std::to_string(rank) + " of " +
                                          std::to_string(all.size()) + ": " + all[rank].message);
  }
}

}  // namespace diptych::parallel
