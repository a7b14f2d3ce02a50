#include "common/parallel/reduction.hpp"

#include <bit>
#include <cmath>

namespace diptych::parallel {

namespace {

constexpr std::int64_t least_key = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t key_of_nan = std::numeric_limits<std::int64_t>::max();

/// Integers in the order of the numbers, NaN above all of them.
std::int64_t key_of(double x) {
  if (std::isnan(x)) return key_of_nan;
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : least_key - bits;
}

double number_of(std::int64_t key) {
  if (key == key_of_nan) return std::numeric_limits<double>::quiet_NaN();
  return std::bit_cast<double>(key >= 0 ? key : least_key - key);
}

}  // namespace

size_t Reduction::new_sum(double& result) {
  sums_.push_back({{}, &result});
  return sums_.size() - 1;
}

void Reduction::sum(const std::vector<double>& of_chunks, double& result) {
  const size_t sum = new_sum(result);
  for_own_chunks(part_, std::ssize(of_chunks), [&](size_t chunk) { add(sum, of_chunks[chunk]); });
}

void Reduction::extreme(const std::vector<double>& of_chunks, double sign, double& result) {
  std::int64_t key = key_of(-std::numeric_limits<double>::infinity());
  for_own_chunks(part_, std::ssize(of_chunks),
                 [&](size_t chunk) { key = std::max(key, key_of(sign * of_chunks[chunk])); });
  extremes_.push_back({key, sign, &result});
}

void Reduction::largest(const std::vector<double>& of_chunks, double& result) {
  extreme(of_chunks, 1, result);
}

void Reduction::least(const std::vector<double>& of_chunks, double& result) {
  extreme(of_chunks, -1, result);
}

void Reduction::finish() {
  if (!part_.is_whole()) {
    std::vector<std::int64_t> words, keys;
    for (Sum& sum : sums_)
      words.insert(words.end(), sum.exact.words().begin(), sum.exact.words().end());
    for (const Extreme& extreme : extremes_)
      keys.push_back(extreme.key);
    part_.ranks().reduce(words, keys);
    auto word = words.begin();
    for (Sum& sum : sums_)
      for (std::int64_t& mine : sum.exact.words())
        mine = *word++;
    for (size_t i = 0; i < keys.size(); ++i)
      extremes_[i].key = keys[i];
  }
  for (const Sum& sum : sums_)
    *sum.result = sum.exact.value();
  for (const Extreme& extreme : extremes_)
    *extreme.result = extreme.sign * number_of(extreme.key);
}

}  // namespace diptych::parallel
