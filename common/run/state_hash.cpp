#include "common/run/state_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace diptych::run {

template <int Dim>
std::string state_hash(const scheme::Body<Dim>& body,
                       const std::vector<std::int32_t>& order,
                       double time) {
  std::vector<std::int64_t> node_of(order.size());
  for (size_t a = 0; a < order.size(); ++a)
    node_of[order[a]] = static_cast<std::int64_t>(a);
  std::vector<double> all{time};
  std::string_view last;
  for (const scheme::Field<Dim>& field : body.fields()) {
    if (field.role != scheme::Role::unknown || field.name == last) continue;
    const auto values = scheme::values_of(body, field.name, node_of);
    all.insert(all.end(), values.begin(), values.end());
    last = field.name;
  }
  const XXH128_hash_t hash = XXH3_128bits(all.data(), all.size() * sizeof(double));
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

template std::string state_hash(const scheme::Body<2>&, const std::vector<std::int32_t>&, double);
template std::string state_hash(const scheme::Body<3>&, const std::vector<std::int32_t>&, double);

}  // namespace diptych::run
