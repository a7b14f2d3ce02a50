/// summary.json: to_json writes every key of the contract, summary_from_json asks for every one of
/// them. A number that is not finite is written as null, so that a broken run can still say what it
/// was; reading null where a number is due is an error, so that no comparison ever uses it. Keys
/// that this version does not know are left alone: the contract lets later versions add some.

#include "common/io/run_record.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/io/json_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace diptych::io {
namespace {

using Json = nlohmann::ordered_json;

Json norms_json(const ErrorNorms& norms) {
  return {{"l1", norms.l1}, {"l2", norms.l2}, {"linf", norms.linf}};
}

Json energy_json(const EnergySummary& energy) {
  return {{"kinetic", energy.kinetic},
          {"strain", energy.strain},
          {"viscous_dissipation", energy.viscous_dissipation},
          {"numerical_dissipation", energy.numerical_dissipation},
          {"external_work", energy.external_work},
          {"projection_work", energy.projection_work},
          {"relative_residual", energy.relative_residual}};
}

Json quantity_json(const QuantitySummary& quantity) {
  Json json = {{"unit", quantity.unit},
               {"final", quantity.final_value},
               {"least", quantity.least},
               {"greatest", quantity.greatest}};
  if (quantity.n_periods == 0) return json;
  json["oscillation"] = {{"periods", quantity.n_periods},
                         {"period", quantity.period},
                         {"mean", quantity.mean},
                         {"amplitude", quantity.amplitude}};
  if (quantity.decrement) json["oscillation"]["logarithmic_decrement"] = *quantity.decrement;
  return json;
}

Json references_json(const std::vector<ReferenceSummary>& references) {
  Json all = Json::object();
  for (const ReferenceSummary& one : references) {
    Json json = {{"probe", one.probe}, {"source", one.source},     {"times", one.n_times},
                 {"until", one.until}, {"greatest", one.greatest}, {"greatest_at", one.greatest_at},
                 {"rms", one.rms},     {"at_end", one.at_end}};
    if (one.uncertainty) json["uncertainty"] = *one.uncertainty;
    all[one.name] = json;
  }
  return all;
}

Json cells_json(const RunSummary& summary) {
  Json json = {{"least_J", summary.least_cell_J}, {"most_inverted", summary.most_inverted_cells}};
  if (summary.inverted_from) json["inverted_from"] = *summary.inverted_from;
  return json;
}

Json failure_json(const RunFailure& failure) {
  Json json = {{"message", failure.message}};
  if (failure.time) json["time"] = *failure.time;
  if (failure.step) json["step"] = *failure.step;
  if (failure.node) json["node"] = *failure.node;
  if (failure.place) json["place"] = *failure.place;
  return json;
}

Json provenance_json(const Provenance& provenance) {
  return {{"version", provenance.version},   {"commit", provenance.commit},
          {"compiler", provenance.compiler}, {"flags", provenance.flags},
          {"cpu", provenance.cpu},           {"instruction_set", provenance.instruction_set},
          {"date", provenance.date},         {"case_hash", provenance.case_hash},
          {"program", provenance.program},   {"input_hash", provenance.input_hash}};
}

/// An object of the file under its dotted name, so that each complaint can say where it is.
class Section {
 public:
  Section(const Json& object, std::string name, const std::string& path)
      : object_(object), name_(std::move(name)), path_(path) {
    if (!object_.is_object()) fail(name_.empty() ? "the file" : name_, "must be an object {...}");
  }

  double number(const char* key) const {
    const Json& value = at(key);
    if (value.is_null()) {
      fail(full(key), "is null: the run had no finite value here, so it cannot be compared");
    }
    if (!value.is_number()) fail(full(key), "must be a number");
    return value.get<double>();
  }

  std::int64_t count(const char* key, std::int64_t most) const {
    const Json& value = at(key);
    if (!value.is_number_integer()) fail(full(key), "must be a whole number");
    const bool too_large = value.is_number_unsigned()
                               ? value.get<std::uint64_t>() > static_cast<std::uint64_t>(most)
                               : false;
    if (too_large || value.get<std::int64_t>() < 0) {
      fail(full(key), fmt::format("must lie between 0 and {}", most));
    }
    return value.get<std::int64_t>();
  }

  int small_count(const char* key) const {
    return static_cast<int>(count(key, std::numeric_limits<int>::max()));
  }
  std::int64_t large_count(const char* key) const {
    return count(key, std::numeric_limits<std::int64_t>::max());
  }

  std::string text(const char* key) const {
    const Json& value = at(key);
    if (!value.is_string()) fail(full(key), "must be a text");
    return value.get<std::string>();
  }

  /// Three numbers.
  std::array<double, 3> place(const char* key) const {
    const Json& value = at(key);
    std::array<double, 3> X{};
    if (!value.is_array() || value.size() != X.size()) fail(full(key), "must be three numbers");
    for (size_t i = 0; i < X.size(); ++i) {
      if (!value[i].is_number()) fail(full(key), "must be three numbers");
      X[i] = value[i].get<double>();
    }
    return X;
  }

  std::vector<std::string> texts(const char* key) const {
    const Json& value = at(key);
    const auto is_text = [](const Json& entry) { return entry.is_string(); };
    if (!value.is_array() || !std::all_of(value.begin(), value.end(), is_text))
      fail(full(key), "must be a list of texts");
    return value.get<std::vector<std::string>>();
  }

  bool has(const std::string& key) const { return object_.contains(key); }
  Section section(const std::string& key) const { return {at(key), full(key), path_}; }

  std::vector<std::string> keys() const {
    std::vector<std::string> names;
    for (const auto& item : object_.items())
      names.push_back(item.key());
    return names;
  }

 private:
  std::string full(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }

  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw base::InputError(fmt::format("{}: {} {}", path_, name, what));
  }

  const Json& at(const std::string& key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) {
      fail(full(key),
           "is missing; the file is not a whole summary.json" + base::suggestion(key, keys()));
    }
    return *found;
  }

  const Json& object_;
  std::string name_;
  const std::string& path_;
};

EnergySummary read_energy(const Section& section) {
  EnergySummary energy;
  energy.kinetic = section.number("kinetic");
  energy.strain = section.number("strain");
  energy.viscous_dissipation = section.number("viscous_dissipation");
  energy.numerical_dissipation = section.number("numerical_dissipation");
  energy.external_work = section.number("external_work");
  energy.projection_work = section.number("projection_work");
  energy.relative_residual = section.number("relative_residual");
  return energy;
}

RunFailure read_failure(const Section& section) {
  RunFailure failure;
  failure.message = section.text("message");
  if (section.has("time")) failure.time = section.number("time");
  if (section.has("step")) failure.step = section.large_count("step");
  if (section.has("node")) failure.node = section.large_count("node");
  if (section.has("place")) failure.place = section.place("place");
  return failure;
}

Provenance read_provenance(const Section& section) {
  Provenance provenance;
  provenance.version = section.text("version");
  provenance.commit = section.text("commit");
  provenance.compiler = section.text("compiler");
  provenance.flags = section.text("flags");
  provenance.cpu = section.text("cpu");
  provenance.instruction_set = section.text("instruction_set");
  provenance.date = section.text("date");
  provenance.case_hash = section.text("case_hash");
  provenance.program = section.text("program");
  provenance.input_hash = section.text("input_hash");
  return provenance;
}

void read_size_and_cost(const Section& file, RunSummary& summary) {
  summary.nodes = file.large_count("nodes");
  summary.pairs = file.large_count("pairs");
  summary.unknowns_per_node = file.small_count("unknowns_per_node");
  summary.steps = file.large_count("steps");
  summary.stages = file.large_count("stages");
  summary.rejected_steps = file.large_count("rejected_steps");
  summary.restarts = file.large_count("restarts");
  const Section acts = file.section("interventions");
  summary.projections = acts.large_count("projections");
  summary.resynchronisations = acts.large_count("resynchronisations");
  summary.limited_pairs = acts.large_count("limited_pairs");
  summary.threads = file.small_count("threads");
  summary.ranks = file.small_count("ranks");
  const Section communication = file.section("communication");
  summary.imbalance = communication.number("imbalance");
  summary.exchanged_bytes = communication.large_count("exchanged_bytes");
  summary.communication_seconds = communication.number("seconds");
  summary.setup_seconds = file.number("setup_seconds");
  summary.wall_seconds = file.number("wall_seconds");
  summary.loop_seconds = file.number("loop_seconds");
  summary.nanoseconds_per_node_stage = file.number("nanoseconds_per_node_stage");
  summary.nanoseconds_per_node_crossing = file.number("nanoseconds_per_node_crossing");
  summary.peak_rss_bytes = file.large_count("peak_rss_bytes");
  summary.solver_bytes = file.large_count("solver_bytes");
  summary.running_rss_bytes = file.large_count("running_rss_bytes");
  summary.building_rss_bytes = file.large_count("building_rss_bytes");
  summary.dt_min = file.section("dt").number("min");
  summary.dt_max = file.section("dt").number("max");
  summary.spacing = file.number("spacing");
  summary.mean_neighbours = file.number("mean_neighbours");
}

std::vector<QuantitySummary> read_quantities(const Section& section) {
  std::vector<QuantitySummary> quantities;
  for (const std::string& name : section.keys()) {
    const Section entry = section.section(name);
    QuantitySummary quantity;
    quantity.name = name;
    quantity.unit = entry.text("unit");
    quantity.final_value = entry.number("final");
    quantity.least = entry.number("least");
    quantity.greatest = entry.number("greatest");
    if (entry.has("oscillation")) {
      const Section oscillation = entry.section("oscillation");
      quantity.n_periods = oscillation.small_count("periods");
      quantity.period = oscillation.number("period");
      quantity.mean = oscillation.number("mean");
      quantity.amplitude = oscillation.number("amplitude");
      if (oscillation.has("logarithmic_decrement"))
        quantity.decrement = oscillation.number("logarithmic_decrement");
    }
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

std::vector<ReferenceSummary> read_references(const Section& section) {
  std::vector<ReferenceSummary> references;
  for (const std::string& name : section.keys()) {
    const Section entry = section.section(name);
    ReferenceSummary one;
    one.name = name;
    one.probe = entry.text("probe");
    one.source = entry.text("source");
    one.n_times = entry.large_count("times");
    one.until = entry.number("until");
    one.greatest = entry.number("greatest");
    one.greatest_at = entry.number("greatest_at");
    one.rms = entry.number("rms");
    one.at_end = entry.number("at_end");
    if (entry.has("uncertainty")) one.uncertainty = entry.number("uncertainty");
    references.push_back(std::move(one));
  }
  return references;
}

void read_quality(const Section& file, RunSummary& summary) {
  const Section graph = file.section("graph");
  summary.graph_closure = graph.number("closure");
  summary.graph_linear_exactness = graph.number("linear_exactness");
  summary.graph_operators = graph.text("operators");
  const Section errors = file.section("errors");
  for (const std::string& field : errors.keys()) {
    const Section norms = errors.section(field);
    summary.errors[field] = {norms.number("l1"), norms.number("l2"), norms.number("linf")};
  }
  const Section measures = file.section("measures");
  for (const std::string& name : measures.keys())
    summary.measures[name] = measures.number(name.c_str());
  summary.energy = read_energy(file.section("energy"));
  summary.largest_energy = file.number("largest_energy");
  summary.mobile_energy = file.number("mobile_energy");
  summary.contact_loss = file.number("contact_loss");
  const Section momentum = file.section("momentum");
  summary.linear_momentum_drift = momentum.number("linear_drift");
  summary.angular_momentum_drift = momentum.number("angular_drift");
  const Section involution = file.section("involution");
  summary.involution_H = involution.number("H");
  summary.involution_J = involution.number("J");
  summary.min_jacobian = file.number("min_jacobian");
  const Section cells = file.section("cells");
  summary.least_cell_J = cells.number("least_J");
  summary.most_inverted_cells = cells.large_count("most_inverted");
  if (cells.has("inverted_from")) summary.inverted_from = cells.number("inverted_from");
  summary.quantities = read_quantities(file.section("quantities"));
  summary.state_hash = file.text("state_hash");
}

}  // namespace

std::string column_name(const std::string& method, const std::string& variant) {
  return variant.empty() ? method : method + "-" + variant;
}

std::string to_json(const RunSummary& summary) {
  Json errors = Json::object();
  for (const auto& [field, norms] : summary.errors)
    errors[field] = norms_json(norms);
  Json quantities = Json::object();
  for (const QuantitySummary& quantity : summary.quantities)
    quantities[quantity.name] = quantity_json(quantity);
  Json measures = Json::object();
  for (const auto& [name, value] : summary.measures)
    measures[name] = value;
  Json graph = {{"closure", summary.graph_closure},
                {"linear_exactness", summary.graph_linear_exactness},
                {"operators", summary.graph_operators}};
  Json file = {
      {"method", summary.method},
      {"case", summary.case_name},
      {"case_file", summary.case_file},
      {"title", summary.title},
      {"level", summary.level},
      {"dimension", summary.dimension},
      {"nodes", summary.nodes},
      {"pairs", summary.pairs},
      {"unknowns_per_node", summary.unknowns_per_node},
      {"steps", summary.steps},
      {"stages", summary.stages},
      {"rejected_steps", summary.rejected_steps},
      {"restarts", summary.restarts},
      {"interventions",
       {{"projections", summary.projections},
        {"resynchronisations", summary.resynchronisations},
        {"limited_pairs", summary.limited_pairs}}},
      {"threads", summary.threads},
      {"ranks", summary.ranks},
      {"communication",
       {{"imbalance", summary.imbalance},
        {"exchanged_bytes", summary.exchanged_bytes},
        {"seconds", summary.communication_seconds}}},
      {"precision", summary.precision},
      {"arrangement", summary.arrangement},
      {"integrator", summary.integrator},
      {"volumes", summary.volumes},
      {"status", summary.status},
      {"end_time", summary.end_time},
      {"setup_seconds", summary.setup_seconds},
      {"wall_seconds", summary.wall_seconds},
      {"loop_seconds", summary.loop_seconds},
      {"nanoseconds_per_node_stage", summary.nanoseconds_per_node_stage},
      {"nanoseconds_per_node_crossing", summary.nanoseconds_per_node_crossing},
      {"peak_rss_bytes", summary.peak_rss_bytes},
      {"solver_bytes", summary.solver_bytes},
      {"running_rss_bytes", summary.running_rss_bytes},
      {"building_rss_bytes", summary.building_rss_bytes},
      {"dt", {{"min", summary.dt_min}, {"max", summary.dt_max}}},
      {"spacing", summary.spacing},
      {"mean_neighbours", summary.mean_neighbours},
      {"graph", graph},
      {"errors", errors},
      {"measures", measures},
      {"energy", energy_json(summary.energy)},
      {"largest_energy", summary.largest_energy},
      {"mobile_energy", summary.mobile_energy},
      {"contact_loss", summary.contact_loss},
      {"momentum",
       {{"linear_drift", summary.linear_momentum_drift},
        {"angular_drift", summary.angular_momentum_drift}}},
      {"involution", {{"H", summary.involution_H}, {"J", summary.involution_J}}},
      {"min_jacobian", summary.min_jacobian},
      {"cells", cells_json(summary)},
      {"quantities", quantities},
      {"state_hash", summary.state_hash},
      {"provenance", provenance_json(summary.provenance)},
  };
  if (!summary.references.empty()) file["references"] = references_json(summary.references);
  if (!summary.variant.empty()) file["variant"] = summary.variant;
  if (!summary.notices.empty()) file["notices"] = summary.notices;
  if (!summary.unmet.empty()) file["unmet"] = summary.unmet;
  if (summary.failure) file["failure"] = failure_json(*summary.failure);
  // Texts come from the user's case: bytes that are not UTF-8 become U+FFFD instead of an
  // exception.
  return file.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

RunSummary summary_from_json(const std::string& text, const std::string& path) {
  const Json root = parsed_json(text, path);
  const Section file(root, "", path);
  RunSummary summary;
  summary.method = file.text("method");
  summary.case_name = file.text("case");
  summary.case_file = file.text("case_file");
  summary.title = file.text("title");
  summary.level = file.small_count("level");
  summary.dimension = file.small_count("dimension");
  summary.precision = file.text("precision");
  summary.arrangement = file.text("arrangement");
  summary.integrator = file.text("integrator");
  summary.volumes = file.text("volumes");
  summary.status = file.text("status");
  summary.end_time = file.number("end_time");
  read_size_and_cost(file, summary);
  read_quality(file, summary);
  summary.provenance = read_provenance(file.section("provenance"));
  if (file.has("references")) summary.references = read_references(file.section("references"));
  if (file.has("variant")) summary.variant = file.text("variant");
  if (file.has("notices")) summary.notices = file.texts("notices");
  if (file.has("unmet")) summary.unmet = file.text("unmet");
  if (file.has("failure")) summary.failure = read_failure(file.section("failure"));
  return summary;
}

}  // namespace diptych::io
