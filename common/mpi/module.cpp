/// The one room that knows MPI and METIS: a module that the program loads where it was started as
/// several ranks (common/parallel/ranks.hpp). Errors of MPI end the job, with its own message.
/// Test: tests/ranks

#include "common/mpi/watch.hpp"
#include "common/parallel/ranks.hpp"

#include <metis.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace diptych::parallel {

namespace {

/// Counts of MPI are ints.
constexpr std::int64_t most_bytes = std::int64_t{1} << 30;

class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void begin_exchange(std::span<const Parcel> sends, std::span<const Parcel> receives) override {
    const Timing timing(cost_);
    const auto for_pieces = [this](const Parcel& parcel, const auto& start) {
      for (std::int64_t at = 0; at < parcel.n; at += most_bytes) {
        const auto n = static_cast<int>(std::min(most_bytes, parcel.n - at));
        start(parcel.bytes + at, n, parcel.rank, &requests_.emplace_back());
      }
    };
    for (const Parcel& parcel : receives) {
      for_pieces(parcel, [](std::byte* bytes, int n, int from, MPI_Request* request) {
        MPI_Irecv(bytes, n, MPI_BYTE, from, 0, MPI_COMM_WORLD, request);
      });
    }
    for (const Parcel& parcel : sends) {
      cost_.parcel_bytes += parcel.n;
      for_pieces(parcel, [](const std::byte* bytes, int n, int to, MPI_Request* request) {
        MPI_Isend(bytes, n, MPI_BYTE, to, 0, MPI_COMM_WORLD, request);
      });
    }
  }
  void finish_exchange() override {
    const Timing timing(cost_);
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    requests_.clear();
  }
  void all_gather(std::byte* all, std::span<const std::int64_t> bytes) override {
    const Timing timing(cost_);
    const std::int64_t sum = std::accumulate(bytes.begin(), bytes.end(), std::int64_t{0});
    if (sum <= most_bytes) {
      const std::vector<int> counts(bytes.begin(), bytes.end());
      std::vector<int> first(counts.size());
      std::exclusive_scan(counts.begin(), counts.end(), first.begin(), 0);
      MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_BYTE, all, counts.data(), first.data(), MPI_BYTE,
                     MPI_COMM_WORLD);
      return;
    }
    for (int r = 0; r < size_; ++r) {
      broadcast_from(r, all, bytes[r]);
      all += bytes[r];
    }
  }
  void reduce(std::span<std::int64_t> sums, std::span<std::int64_t> largest) override {
    const Timing timing(cost_);
    std::array<MPI_Request, 2> requests{MPI_REQUEST_NULL, MPI_REQUEST_NULL};
    const auto begin = [](std::span<std::int64_t> values, MPI_Op operation, MPI_Request& request) {
      if (values.empty()) return;
      MPI_Iallreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T,
                     operation, MPI_COMM_WORLD, &request);
    };
    begin(sums, MPI_SUM, requests[0]);
    begin(largest, MPI_MAX, requests[1]);
    MPI_Waitall(2, requests.data(), MPI_STATUSES_IGNORE);
  }
  void broadcast(std::byte* bytes, std::int64_t n) override {
    const Timing timing(cost_);
    broadcast_from(0, bytes, n);
  }
  void meet() override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    for (int is_over = 0;;) {
      MPI_Test(&request, &is_over, MPI_STATUS_IGNORE);
      if (is_over != 0) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  CommunicationCost cost() const override { return cost_; }
  void abort(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Adds the time until the end of a scope.
  struct Timing {
    explicit Timing(CommunicationCost& of) : cost(of) {}
    Timing(const Timing&) = delete;
    Timing& operator=(const Timing&) = delete;
    ~Timing() { cost.seconds += std::chrono::duration<double>(Clock::now() - start).count(); }
    CommunicationCost& cost;
    Clock::time_point start = Clock::now();
  };
  void broadcast_from(int root, std::byte* bytes, std::int64_t n) {
    for (std::int64_t at = 0; at < n; at += most_bytes) {
      MPI_Bcast(bytes + at, static_cast<int>(std::min(most_bytes, n - at)), MPI_BYTE, root,
                MPI_COMM_WORLD);
    }
  }

  int rank_ = 0, size_ = 1;
  std::vector<MPI_Request> requests_;
  CommunicationCost cost_;
};

std::unique_ptr<Watch> watch;
int patience = 0;  ///< s, of rank 0, while there are ranks; 0: for ever

/// What each rank tells all: environments may differ from machine to machine, and what ranks do
/// together is to begin on all of them or on none.
struct Start {
  int patience = 0;  ///< s, negative: no number
  int threads = 0;   ///< that MPI provides
  int launched = 0;  ///< ranks, by the environment
};

std::vector<Start> starts_of_all(const Start& mine, int n_ranks) {
  std::vector<Start> all(static_cast<size_t>(n_ranks));
  MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, MPI_COMM_WORLD);
  return all;
}

/// The same on all ranks; empty where they can begin.
std::string fault_in(const std::vector<Start>& all) {
  for (size_t r = 0; r < all.size(); ++r) {
    const std::string who =
        " (rank " + std::to_string(r) + " of " + std::to_string(all.size()) + ")";
    if (all[r].launched != static_cast<int>(all.size())) {
      return "the program was started among " + std::to_string(all[r].launched) +
             " processes and MPI sees " + std::to_string(all.size()) + who +
             "; use the mpirun of the MPI that it was built with";
    }
    if (all[r].patience < 0)
      return "DIPTYCH_RANK_PATIENCE is no number of seconds from 0 to 1000000" + who;
    if (all[0].patience > 0 && all[r].threads < MPI_THREAD_MULTIPLE) {
      return "this MPI has no MPI_THREAD_MULTIPLE" + who +
             ", which ranks need to watch each other; set DIPTYCH_RANK_PATIENCE=0 to do without";
    }
  }
  return "";
}

/// On a shared machine a rank that spins for a message takes the processor from the one that is to
/// send it. Open MPI reads its settings in MPI_Init, and those of its environment and of mpirun are
/// kept; others take no notice.
void leave_processor_while_waiting() {
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

Communicator* begin(std::string& error, const char* (*phase)(), PassedSignals signals) {
  leave_processor_while_waiting();
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &provided) != MPI_SUCCESS ||
      provided < MPI_THREAD_FUNNELED) {
    error = "MPI_Init_thread failed";
    return nullptr;
  }
  static MpiCommunicator world;
  const auto all =
      starts_of_all({rank_patience().value_or(-1), provided, launched_ranks()}, world.size());
  error = fault_in(all);
  if (!error.empty()) {
    MPI_Finalize();
    return nullptr;
  }
  patience = all[0].patience;
  if (patience > 0) watch = std::make_unique<Watch>(patience, phase, signals);
  return &world;
}

void end() {
  watch.reset();
  std::optional<Countdown> countdown;
  if (patience > 0) {
    countdown.emplace(patience, "diptych: a rank has not been heard of for " +
                                    std::to_string(patience) +
                                    " s, last in its end: it is stopped, or its machine is lost; "
                                    "the job ends here. All that it had to write is written.\n");
  }
  MPI_Finalize();
}

template <class To, class From>
std::vector<To> as(const std::vector<From>& from) {
  return {from.begin(), from.end()};
}

/// The same in proportion, so small that METIS, which adds them up in an idx_t, has room for their
/// sum.
std::vector<idx_t> in_room(const std::vector<std::int64_t>& weights) {
  constexpr std::int64_t most = std::numeric_limits<idx_t>::max() / 4;
  const std::int64_t sum = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
  const std::int64_t share = sum / most + 1;
  std::vector<idx_t> small;
  for (const std::int64_t weight : weights)
    small.push_back(static_cast<idx_t>(std::max<std::int64_t>(1, weight / share)));
  return small;
}

std::vector<int> metis(const ChunkGraph& graph, int n_parts) {
  idx_t n = static_cast<idx_t>(graph.n_chunks()), n_constraints = 1, parts = n_parts, cut = 0;
  std::vector<idx_t> row = as<idx_t>(graph.row), neighbour = as<idx_t>(graph.neighbour);
  std::vector<idx_t> work = in_room(graph.work), weight = in_room(graph.weight);
  std::vector<idx_t> owner(graph.work.size());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  const int status =
      METIS_PartGraphKway(&n, &n_constraints, row.data(), neighbour.data(), work.data(), nullptr,
                          weight.data(), &parts, nullptr, nullptr, options, &cut, owner.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (status != METIS_OK) {
    throw std::runtime_error("METIS finds no partition (status " + std::to_string(status) +
                             "); use --partition bisection or slab");
  }
  return as<int>(owner);
}

constexpr RanksModule ranks_module{begin, end, metis};

}  // namespace

}  // namespace diptych::parallel

extern "C" const diptych::parallel::RanksModule* diptych_ranks_module_2() {
  return &diptych::parallel::ranks_module;
}
