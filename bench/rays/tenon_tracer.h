#pragma once

#include <memory>

#include "rays/tracer.h"

namespace tenon::bench {

/// Tenon by its public interface. trace() is the one place where the bench asks a structure.
class TenonTracer final : public Tracer {
 public:
  TenonTracer(std::string name, const Accelerator& accelerator) : Tracer(std::move(name)), accelerator_(accelerator) {}

  void load(const RaySet& set, int threads) override;
  void trace(std::size_t begin, std::size_t end, int worker) override;
  std::vector<Answer> answers() const override { return answers_; }
  void unload() override;

 private:
  struct Worker {
    std::unique_ptr<TraceContext> context;
    std::vector<Hit> hits;
  };

  const Accelerator& accelerator_;
  const RaySet* set_ = nullptr;
  std::vector<Worker> workers_;
  std::vector<Answer> answers_;
};

}  // namespace tenon::bench
