// A whole subdivided cage on the CPU, and which of its samples are one point.
#pragma once

#include "surface/kernel/reference.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace supple::test {

/// The mesh of a cage that must be accepted.
inline surface::kernel::Mesh kernelMesh(const cage::Cage& cage, surface::kernel::Subdivision subdivision) {
    Result<surface::kernel::Mesh> mesh = surface::kernel::buildMesh(cage, subdivision);
    if (!mesh.ok()) {
        ADD_FAILURE() << mesh.error().message;
        return {};
    }
    return std::move(*mesh);
}

} // namespace supple::test
