#include "common/scheme/body/body.hpp"

#include "common/scheme/graph/centroid.hpp"
#include "common/scheme/ranks/division.hpp"

#include <algorithm>
#include <stdexcept>

namespace diptych::scheme {

template <int Dim>
Body<Dim>::Body(const PairGraph& whole, const BodyOptions& what, SweepGraph<Dim> sub_graph)
    : graph(std::move(sub_graph)),
      options(what),
      n_owned(graph.n_nodes),
      n_stored(graph.n_nodes),
      n_blocks(graph.n_blocks),
      X(whole.X),
      centroid(centroid_of(whole)) {
  if (options.cell_shear != 0 && options.volumes != Volumes::cells)
    throw std::logic_error("gradients of cells carry shear beside volumes of cells alone");
  list_fields();
  allocate();
  bulk = make_bulk_volumes<Dim>(whole, options.volumes, options.cell_shear != 0);
  if (options.hourglass != 0) hourglass = std::make_unique<HourglassControl<Dim>>(whole);
}

template <int Dim>
Body<Dim>::Body(const PairGraph& whole, const BodyOptions& what)
    : Body(whole, what, SweepGraph<Dim>(whole, what.has_slopes)) {}

template <int Dim>
Body<Dim>::Body(const PairGraph& whole, const BodyOptions& what, Arrangement arrangement)
    : Body(whole, what, SweepGraph<Dim>(whole, arrangement, what.has_slopes)) {}

template <int Dim>
void Body<Dim>::list_fields() {
  using Layout = algebra::Layout<Dim>;
  using Record = NodeRecord<Dim>;
  using enum Role;
  const bool evolves_H = options.unknowns == Unknowns::FHJ;
  const bool evolves_J = options.unknowns != Unknowns::F;
  const int n_A = options.n_branches * Layout::n_A;
  const int n_S = options.has_G ? options.n_branches * Layout::n_S : 0;
  const int record_stride = is_single() ? Record::template stride<float>(options.exact_impedance)
                                        : Record::template stride<double>(options.exact_impedance);
  const auto in_table = [&](NodeTable Body::*table, int stride, bool read) {
    return [=, this](const char* name, const char* unit, int n, Role role, int first) {
      if (n > 0) fields_.push_back({name, unit, n, role, table, nullptr, first, stride, read});
    };
  };
  const auto in_block = [&](const char* name, const char* unit, int n, Role role,
                            BlockField Body::*block) {
    if (n > 0) fields_.push_back({name, unit, n, role, nullptr, block, 0, 0, false});
  };
  const auto velocity = in_table(&Body::v, vector_stride<Dim>, true);
  const auto record = in_table(&Body::records, record_stride, true);
  const auto frame = in_table(&Body::frames, NodeFrame<Dim>::stride, true);
  const auto force = in_table(&Body::T, vector_stride<Dim>, false);
  const auto moment = in_table(&Body::moments, tensor_stride<Dim>, false);
  const auto gradient = in_table(&Body::gradients, tensor_stride<Dim>, true);
  const auto stress = in_table(&Body::stresses, tensor_stride<Dim>, true);

  velocity("v", "m/s", Dim, unknown, 0);
  in_block("u", "m", Dim, unknown, &Body::u);
  in_block("F", "-", Layout::n_F, unknown, &Body::F);
  record("H", "-", Dim * Dim, evolves_H ? unknown : derived, Record::H);
  in_block("H", "-", evolves_H ? Layout::n_H - Dim * Dim : 0, unknown, &Body::H_33);
  in_block("J", "-", evolves_J ? 1 : 0, unknown, &Body::J);
  in_block("A", "-", n_A, unknown, &Body::A);
  in_block("S", "-", n_S, unknown, &Body::S);

  in_block("v_0", "m/s", Dim, step_begin, &Body::v_0);
  in_block("u_0", "m", Dim, step_begin, &Body::u_0);
  in_block("F_0", "-", Layout::n_F, step_begin, &Body::F_0);
  in_block("H_0", "-", evolves_H ? Layout::n_H : 0, step_begin, &Body::H_0);
  in_block("J_0", "-", evolves_J ? 1 : 0, step_begin, &Body::J_0);
  in_block("L_0", "1/s", options.keeps_L_0 ? Layout::n_F : 0, step_begin, &Body::L_0);

  record("P", "Pa", Dim * Dim, derived, Record::P);
  record(options.has_slopes ? "slopes" : "L", "1/s", Dim * Dim, derived, Record::L);
  in_block("L", "1/s", options.has_slopes ? Dim * Dim : 0, derived, &Body::rates);
  record("z", "kg/(m^2 s)", 2, derived, Record::z_p);
  if (options.exact_impedance) {
    record("F", "-", Dim * Dim, derived, Record::F);
    record("A_tot", "Pa", Layout::n_A, derived, Record::A_tot);
    record("S_tot", "Pa", Layout::n_S, derived, Record::S_tot);
    record("W_JJ", "Pa", 1, derived, Record::W_JJ);
    record("W_FJ", "Pa", 1, derived, Record::W_FJ);
  }
  if (options.has_frames) {
    frame("F of frames", "-", Dim * Dim, derived, NodeFrame<Dim>::F);
    frame("u of frames", "m", Dim, derived, NodeFrame<Dim>::u);
    frame("spin", "1/s", NodeFrame<Dim>::n_spin, derived, NodeFrame<Dim>::spin);
  }
  force("T", "N", Dim, accumulated, 0);
  force("rate", "kg/s", in_runs() ? 1 : 0, accumulated, Dim);
  if (options.has_moments) moment("moments", "Pa", Dim * Dim, accumulated, 0);
  if (options.face_correction) {
    gradient("plain L", "1/s", Dim * Dim, derived, 0);
    stress("plain P", "Pa", Dim * Dim, derived, 0);
  }
}

template <int Dim>
void Body<Dim>::allocate() {
  for (const Field<Dim>& field : fields_) {
    if (field.block != nullptr) {
      this->*field.block = BlockField(n_stored, field.n_components, is_single());
      continue;
    }
    if (!(this->*field.table).empty()) continue;  // by an earlier row of this table
    int n = 0;
    for (const Field<Dim>& other : fields_) {
      if (other.table == field.table) n = std::max(n, other.first + other.n_components);
    }
    this->*field.table = NodeTable(n_stored, n, field.stride, graph.shape);
  }
}

template <int Dim>
const parallel::Part& Body<Dim>::part() const {
  static const parallel::Part whole;
  return division ? division->part : whole;
}

template <int Dim>
std::int64_t Body<Dim>::bytes() const {
  std::int64_t sum = 0;
  std::vector<NodeTable Body::*> counted;
  for (const Field<Dim>& field : fields_) {
    if (field.block != nullptr) {
      sum += (this->*field.block).bytes();
    } else if (std::find(counted.begin(), counted.end(), field.table) == counted.end()) {
      sum += (this->*field.table).bytes();
      counted.push_back(field.table);
    }
  }
  return sum + (bulk ? bulk->bytes() : 0) + (hourglass ? hourglass->bytes() : 0);
}

template <int Dim>
int Body<Dim>::unknowns_per_node() const {
  int n = 0;
  for (const Field<Dim>& field : fields_)
    n += field.role == Role::unknown ? field.n_components : 0;
  return n;
}

template <int Dim>
std::vector<double> values_of(const Body<Dim>& body,
                              std::string_view name,
                              const std::vector<std::int64_t>& nodes) {
  std::vector<const Field<Dim>*> rows;
  for (const Field<Dim>& field : body.fields()) {
    if (field.name == name && (rows.empty() || field.role == rows.front()->role))
      rows.push_back(&field);
  }
  std::vector<double> values;
  for (const std::int64_t a : nodes) {
    for (const Field<Dim>* field : rows) {
      for (int c = 0; c < field->n_components; ++c)
        values.push_back(field->at(body, a, c));
    }
  }
  return values;
}

template struct Body<2>;
template struct Body<3>;
template std::vector<double> values_of(const Body<2>&,
                                       std::string_view,
                                       const std::vector<std::int64_t>&);
template std::vector<double> values_of(const Body<3>&,
                                       std::string_view,
                                       const std::vector<std::int64_t>&);

}  // namespace diptych::scheme
