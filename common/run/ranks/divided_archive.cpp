#include "common/run/ranks/divided_archive.hpp"

#include "common/base/error.hpp"
#include "common/parallel/sharing.hpp"
#include "common/scheme/body/node_chunks.hpp"

#include <algorithm>

namespace diptych::run {

namespace {

/// use(chunk, begin, end) of the rows of [first, last), by the chunks of nodes that they are of.
template <class Use>
void for_chunks_of_rows(std::int64_t first, std::int64_t last, const Use& use) {
  for (std::int64_t begin = first; begin < last;) {
    const std::int64_t chunk = scheme::chunk_of_node(begin),
                       end = std::min(last, (chunk + 1) * scheme::chunk_nodes);
    use(chunk, begin, end);
    begin = end;
  }
}

}  // namespace

/// To the other ranks.
void DividedArchive::say(bool goes_on) {
  parallel::share(ranks_, goes_on);
}

/// On the other ranks.
void DividedArchive::require_going_on() {
  bool goes_on = false;
  parallel::share(ranks_, goes_on);
  if (!goes_on) throw base::InputError("rank 0 says what is wrong with the file");
}

/// use() on rank 0, and whether the others can go on after it.
template <class Use>
void DividedArchive::use_file(const Use& use) {
  try {
    use();
  } catch (...) {
    say(false);
    throw;
  }
  say(true);
}

template <class Value, class Use>
void DividedArchive::use_file_for(Value& value, const Use& use) {
  if (ranks_.rank() == 0) {
    use_file(use);
  } else {
    require_going_on();
  }
  if (is_loading()) parallel::share(ranks_, value);
}

void DividedArchive::reals(const std::string& name,
                           const std::string& unit,
                           std::vector<double>& values,
                           int n_columns,
                           std::int64_t n_rows) {
  use_file_for(values, [&] { file_.reals(name, unit, values, n_columns, n_rows); });
}

void DividedArchive::integers(const std::string& name,
                              std::vector<std::int64_t>& values,
                              std::int64_t n_rows) {
  use_file_for(values, [&] { file_.integers(name, values, n_rows); });
}

void DividedArchive::text(const std::string& name, std::string& value) {
  use_file_for(value, [&] { file_.text(name, value); });
}

/// Brings to rank 0 the rows of values, of which `put` puts some, from those that own them.
void DividedArchive::collect(std::int64_t first,
                             std::span<double> values,
                             int n_columns,
                             const Rows& put) {
  const std::int64_t last = first + std::ssize(values) / n_columns;
  std::vector<std::vector<double>> of_rank(static_cast<size_t>(ranks_.size()));
  const bool is_first = ranks_.rank() == 0;
  const auto for_rows = [&](const auto& use) {
    for_chunks_of_rows(first, last, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
      const auto piece = values.subspan(static_cast<size_t>((begin - first) * n_columns),
                                        static_cast<size_t>((end - begin) * n_columns));
      const int owner = part_.owner(chunk);
      use(owner, of_rank[static_cast<size_t>(owner)], begin, piece);
    });
  };
  for_rows([&](int owner, std::vector<double>& theirs, std::int64_t begin, auto piece) {
    if (owner == ranks_.rank()) put(begin, piece);
    if (is_first && owner != 0) theirs.resize(theirs.size() + piece.size());
    if (!is_first && owner == ranks_.rank())
      theirs.insert(theirs.end(), piece.begin(), piece.end());
  });
  std::vector<parallel::Parcel> parcels;
  for (int rank = 1; rank < ranks_.size(); ++rank) {
    std::vector<double>& theirs = of_rank[static_cast<size_t>(rank)];
    if (theirs.empty()) continue;
    const auto n_bytes = std::ssize(theirs) * static_cast<std::int64_t>(sizeof(double));
    parcels.push_back({is_first ? rank : 0, parallel::bytes_of(theirs.data()), n_bytes});
  }
  if (is_first) {
    ranks_.begin_exchange({}, parcels);
  } else {
    ranks_.begin_exchange(parcels, {});
  }
  ranks_.finish_exchange();
  if (!is_first) return;
  std::vector<size_t> taken(of_rank.size());
  for_rows([&](int owner, const std::vector<double>& theirs, std::int64_t, auto piece) {
    if (owner == 0) return;
    size_t& begin = taken[static_cast<size_t>(owner)];
    std::copy_n(&theirs[begin], piece.size(), piece.data());
    begin += piece.size();
  });
}

void DividedArchive::rows(const std::string& name,
                          const std::string& unit,
                          int n_columns,
                          std::int64_t n_rows,
                          const Rows& part) {
  const auto exchange = [&](std::int64_t first, std::span<double> values) {
    if (!is_loading()) {
      collect(first, values, n_columns, part);
      return;
    }
    ranks_.broadcast(parallel::bytes_of(values.data()),
                     std::ssize(values) * static_cast<std::int64_t>(sizeof(double)));
    part(first, values);
  };
  if (ranks_.rank() == 0) {
    use_file([&] {
      file_.rows(name, unit, n_columns, n_rows, [&](std::int64_t first, std::span<double> values) {
        say(true);
        exchange(first, values);
      });
    });
    return;
  }
  std::vector<double> values;
  algebra::for_parts(n_rows, [&](std::int64_t first, std::int64_t n) {
    require_going_on();
    values.resize(static_cast<size_t>(n * n_columns));
    exchange(first, values);
  });
  require_going_on();
}

}  // namespace diptych::run
