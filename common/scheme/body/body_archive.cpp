#include "common/scheme/body/body_archive.hpp"

#include "common/scheme/ranks/untouched.hpp"

#include <string>

namespace diptych::scheme {

namespace {

const char* name_of(Role role) {
  switch (role) {
    case Role::unknown:
      return "unknown";
    case Role::step_begin:
      return "step begin";
    case Role::derived:
      return "derived";
    case Role::accumulated:
      break;
  }
  return "accumulated";
}

/// The rows of the table of fields that are one field, in two places or in one.
template <int Dim>
using Places = std::vector<const Field<Dim>*>;

template <int Dim>
void archive_field(Body<Dim>& body,
                   const Places<Dim>& places,
                   const std::string& name,
                   algebra::Archive& archive) {
  int n = 0;
  for (const Field<Dim>* place : places)
    n += place->n_components;
  const bool is_loading = archive.is_loading();
  archive.rows(name, std::string(places.front()->unit), n, body.n_stored,
               [&](std::int64_t first, std::span<double> values) {
                 const std::int64_t last = first + std::ssize(values) / n;
                 int column = 0;
                 for (const Field<Dim>* place : places) {
                   // what is kept may be shared with ranks that have other nodes
                   const Blocks untouched = is_loading ? untouched_of(body, *place) : Blocks();
                   for_touched(untouched, first, last, [&](std::int64_t a) {
                     double* const row = &values[static_cast<size_t>((a - first) * n + column)];
                     for (int c = 0; c < place->n_components; ++c) {
                       if (is_loading) {
                         place->set(body, a, c, row[c]);
                       } else {
                         row[c] = place->at(body, a, c);
                       }
                     }
                   });
                   column += place->n_components;
                 }
               });
}

}  // namespace

template <int Dim>
void archive_fields(Body<Dim>& body, Role role, algebra::Archive& archive) {
  const std::vector<Field<Dim>>& fields = body.fields();
  for (size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].role != role) continue;
    Places<Dim> places{&fields[i]};
    while (i + 1 < fields.size() && fields[i + 1].name == fields[i].name &&
           fields[i + 1].role == role)
      places.push_back(&fields[++i]);
    archive_field(body, places,
                  std::string("body/") + name_of(role) + "/" + std::string(places.front()->name),
                  archive);
  }
}

template void archive_fields(Body<2>&, Role, algebra::Archive&);
template void archive_fields(Body<3>&, Role, algebra::Archive&);

}  // namespace diptych::scheme
