#include "common/scheme/ranks/exchange.hpp"

#include <algorithm>

namespace diptych::scheme {

namespace {

using algebra::n_lanes;

/// Rows of the table of fields that stand in different memory: of a table in rows, whose rows go
/// whole, one.
template <int Dim, class Wanted>
std::vector<const Field<Dim>*> places_of(const Body<Dim>& body, const Wanted& wanted) {
  std::vector<const Field<Dim>*> places;
  for (const Field<Dim>& field : body.fields()) {
    if (!wanted(field)) continue;
    const bool is_there = !body.in_runs() && field.table != nullptr &&
                          std::any_of(places.begin(), places.end(), [&](const Field<Dim>* place) {
                            return place->table == field.table;
                          });
    if (!is_there) places.push_back(&field);
  }
  return places;
}

/// For parallel::Halo: memory of nodes that neighbours read in these tables.
template <int Dim>
auto pieces_of(Body<Dim>& body, Tables<Dim> tables) {
  const auto places = places_of(body, [&](const Field<Dim>& field) {
    return field.read_by_neighbours &&
           std::find(tables.begin(), tables.end(), field.table) != tables.end();
  });
  return [&body, places](std::int64_t begin, std::int64_t end, const auto& use) {
    for (const Field<Dim>* place : places)
      (body.*place->table).for_pieces(begin, end, place->first, place->n_components, use);
  };
}

/// Memory of whole chunks.
template <int Dim, class Use>
void for_pieces_of_chunk(Body<Dim>& body,
                         const Field<Dim>& field,
                         std::int64_t chunk,
                         const Use& use) {
  const std::int64_t begin = chunk * parallel::chunk_size,
                     end = std::min(body.n_blocks, begin + parallel::chunk_size);
  if (field.block != nullptr) {
    (body.*field.block).for_pieces(begin, end, use);
  } else {
    (body.*field.table)
        .for_pieces(begin * n_lanes, end * n_lanes, field.first, field.n_components, use);
  }
}

/// Chunks of the rank, in one parcel.
template <int Dim>
std::vector<std::byte> packed(Body<Dim>& body,
                              const Field<Dim>& field,
                              const std::vector<std::int64_t>& chunks) {
  std::vector<std::byte> bytes;
  for (const std::int64_t chunk : chunks) {
    for_pieces_of_chunk(body, field, chunk, [&](const std::byte* piece, size_t n) {
      bytes.insert(bytes.end(), piece, piece + n);
    });
  }
  return bytes;
}

/// Rank 0 takes a field chunk by chunk from its owners, a rank after the other.
template <int Dim>
void gather_field(Body<Dim>& body, const Field<Dim>& field) {
  const parallel::Part& part = body.part();
  parallel::Communicator& ranks = part.ranks();
  if (ranks.rank() != 0) {
    std::vector<std::byte> bytes = packed(body, field, part.own_chunks());
    const parallel::Parcel parcel{0, bytes.data(), std::ssize(bytes)};
    ranks.begin_exchange({&parcel, 1}, {});
    ranks.finish_exchange();
    return;
  }
  const std::int64_t n_chunks = parallel::n_chunks_of(body.n_blocks);
  for (int rank = 1; rank < ranks.size(); ++rank) {
    std::vector<std::int64_t> chunks;
    size_t size = 0;
    for (std::int64_t chunk = 0; chunk < n_chunks; ++chunk) {
      if (part.owner(chunk) != rank) continue;
      chunks.push_back(chunk);
      for_pieces_of_chunk(body, field, chunk, [&](const std::byte*, size_t n) { size += n; });
    }
    std::vector<std::byte> bytes(size);
    const parallel::Parcel parcel{rank, bytes.data(), std::ssize(bytes)};
    ranks.begin_exchange({}, {&parcel, 1});
    ranks.finish_exchange();
    const std::byte* from = bytes.data();
    for (const std::int64_t chunk : chunks) {
      for_pieces_of_chunk(body, field, chunk, [&](std::byte* piece, size_t n) {
        std::memcpy(piece, from, n);
        from += n;
      });
    }
  }
}

}  // namespace

template <int Dim>
void begin_exchange(Body<Dim>& body, Tables<Dim> tables) {
  body.division->pairs.begin(pieces_of(body, tables));
}

template <int Dim>
void finish_exchange(Body<Dim>& body, Tables<Dim> tables) {
  body.division->pairs.finish(pieces_of(body, tables));
}

template <int Dim>
void gather(Body<Dim>& body, Role role) {
  if (!body.division) return;
  for (const Field<Dim>* place :
       places_of(body, [&](const Field<Dim>& field) { return field.role == role; }))
    gather_field(body, *place);
}

template <int Dim>
void gather_state(Body<Dim>& body) {
  for (const Role role : {Role::unknown, Role::derived, Role::accumulated})
    gather(body, role);
}

#define DIPTYCH_INSTANTIATE(Dim)                          \
  template void begin_exchange(Body<Dim>&, Tables<Dim>);  \
  template void finish_exchange(Body<Dim>&, Tables<Dim>); \
  template void gather(Body<Dim>&, Role);                 \
  template void gather_state(Body<Dim>&);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
