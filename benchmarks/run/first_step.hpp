#pragma once
/// Does something once the first step has been made.

#include "common/run/observers/observer.hpp"

#include <functional>
#include <utility>

namespace diptych::harness {

class FirstStep : public run::Observer {
 public:
  explicit FirstStep(std::function<void()> then) : then_(std::move(then)) {}
  void after_step(const run::StepReport&) override {
    if (!then_) return;
    then_();
    then_ = nullptr;
  }

 private:
  std::function<void()> then_;
};

}  // namespace diptych::harness
