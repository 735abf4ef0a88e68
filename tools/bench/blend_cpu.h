// The blending surface on the CPU in plain loops, as a contender: its paper compares a GPU with such a program.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace supple::bench {

class BlendCpu {
public:
    /// Closed cages of quads without creases.
    [[nodiscard]] static Result<std::unique_ptr<BlendCpu>> create(const cage::Cage& cage, uint32_t rate);
    ~BlendCpu();
    BlendCpu(const BlendCpu&) = delete;
    BlendCpu& operator=(const BlendCpu&) = delete;

    /// Coefficients of all charts, then positions and unit normals of all samples, face after face; on one thread, or
    /// on as many as the machine has.
    void run(bool allThreads);
    /// x, y, z of the position, then of the normal; (rate + 1)^2 samples a face.
    [[nodiscard]] std::span<const float> vertices() const;

private:
    struct Inside;
    explicit BlendCpu(std::unique_ptr<Inside> inside);
    std::unique_ptr<Inside> inside_;
};

} // namespace supple::bench
