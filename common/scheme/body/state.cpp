#include "common/scheme/body/state.hpp"

namespace diptych::scheme {

template <int Dim>
State<Dim>::State(std::int64_t n,
                  int branches,
                  bool G,
                  Unknowns which,
                  bool exact_impedance,
                  bool keep_L_0,
                  const algebra::TableShape& table_shape)
    : n_nodes(n),
      n_blocks(algebra::n_blocks_of(n)),
      n_branches(branches),
      has_G(G),
      unknowns(which),
      shape(table_shape) {
  using Layout = algebra::Layout<Dim>;
  for (BlockField* f : {&u, &v_0, &u_0})
    *f = BlockField(n, Dim, shape.single);
  for (BlockField* f : {&F, &F_0})
    *f = BlockField(n, Layout::n_F, shape.single);
  if (keep_L_0) L_0 = BlockField(n, Layout::n_F, shape.single);
  if (which == Unknowns::FHJ) {
    H_0 = BlockField(n, Layout::n_H, shape.single);
    if (Dim == 2) H_33 = BlockField(n, 1, shape.single);
  }
  if (which != Unknowns::F) {
    for (BlockField* f : {&J, &J_0})
      *f = BlockField(n, 1, shape.single);
  }
  if (branches > 0) {
    A = BlockField(n, branches * Layout::n_A, shape.single);
    if (G) S = BlockField(n, branches * Layout::n_S, shape.single);
  }
  v = algebra::NodeTable(n, Dim, vector_stride<Dim>, shape);
  using Record = NodeRecord<Dim>;
  const int stride = shape.single ? Record::template stride<float>(exact_impedance)
                                  : Record::template stride<double>(exact_impedance);
  records = algebra::NodeTable(n, Record::n(exact_impedance), stride, shape);
  const bool runs = shape.arrangement == algebra::Arrangement::runs;
  T = algebra::NodeTable(n, runs ? Dim + 1 : Dim, vector_stride<Dim>, shape);
}

template <int Dim>
void State<Dim>::allow_face_correction() {
  gradients = algebra::NodeTable(n_nodes, Dim * Dim, tensor_stride<Dim>, shape);
  stresses = algebra::NodeTable(n_nodes, Dim * Dim, tensor_stride<Dim>, shape);
}

template <int Dim>
std::int64_t State<Dim>::bytes() const {
  std::int64_t sum = 0;
  for (const algebra::NodeTable* t : {&v, &records, &T, &gradients, &stresses})
    sum += t->bytes();
  for (const BlockField* f : {&u, &F, &J, &H_33, &A, &S, &v_0, &u_0, &F_0, &H_0, &J_0, &L_0})
    sum += f->bytes();
  return sum;
}

template <int Dim>
int State<Dim>::unknowns_per_node() const {
  int n = Dim;  // v
  for (const BlockField* f : {&u, &F, &H_0, &J, &A, &S})
    n += f->n_components();
  return n;
}

template struct State<2>;
template struct State<3>;

}  // namespace diptych::scheme
