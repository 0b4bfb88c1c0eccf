#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rays/tracer.h"

namespace tenon::bench {

/// Tenon by its public interface. trace() is the one place where the bench asks a structure.
class TenonTracer final : public Tracer {
 public:
  /// @param batch  rays of one call
  TenonTracer(std::string name, const Accelerator& accelerator, std::size_t batch = block)
      : Tracer(std::move(name)), accelerator_(accelerator), batch_(batch) {}

  void load(const RaySet& set, int threads) override;
  void trace(std::size_t begin, std::size_t end, int worker) override;
  std::vector<Answer> answers() const override;
  Vec3 normal(std::size_t ray) const override;
  void unload() override;

 private:
  const Accelerator& accelerator_;
  std::size_t batch_;
  const RaySet* set_ = nullptr;
  std::vector<std::unique_ptr<TraceContext>> contexts_;
  std::vector<RayBoundary> boundaries_;
  std::vector<std::uint8_t> occluded_;
};

}  // namespace tenon::bench
