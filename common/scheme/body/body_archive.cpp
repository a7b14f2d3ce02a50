#include "common/scheme/body/body_archive.hpp"

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
  std::vector<double> values;
  if (!archive.is_loading()) values.reserve(static_cast<size_t>(body.n_stored * n));
  for (std::int64_t a = 0; !archive.is_loading() && a < body.n_stored; ++a) {
    for (const Field<Dim>* place : places) {
      for (int c = 0; c < place->n_components; ++c)
        values.push_back(place->at(body, a, c));
    }
  }
  archive.reals(name, std::string(places.front()->unit), values, n, body.n_stored);
  if (!archive.is_loading()) return;
  size_t k = 0;
  for (std::int64_t a = 0; a < body.n_stored; ++a) {
    for (const Field<Dim>* place : places) {
      for (int c = 0; c < place->n_components; ++c)
        place->set(body, a, c, values[k++]);
    }
  }
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
