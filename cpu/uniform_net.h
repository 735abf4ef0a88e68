// The uniform bicubic B-spline as a patch.
#pragma once

#include "cage/topology.h"
#include "cpu/form.h"

#include <array>
#include <cstdint>
#include <span>

namespace supple::cpu {

using surface::Form;

/// The 16 coefficients over a quad, u fastest. Four quads meet at each of its corners, and no crease passes.
/// `vertices`: the mesh's.
[[nodiscard]] inline std::array<Form, 16> uniformNet(const cage::Cage& mesh, const cage::Topology& topology,
                                                     std::span<const Form> vertices, uint32_t quad) {
    std::array<Form, 16> net;
    const auto sum = [&](Form& to, uint32_t vertex, double weight) { to.addTimes(vertices[vertex], weight); };
    for (uint32_t j = 0; j < 4; ++j) {
        const uint32_t corner = mesh.faceStarts[quad] + j, vertex = mesh.faceVertices[corner];
        const uint32_t first = topology.spokeStarts[vertex], spoke = topology.cornerSpokes[corner] - first;
        std::array<uint32_t, 4> ends{}, diagonals{}; // from the edge to the next corner on, counter-clockwise
        for (uint32_t k = 0; k < 4; ++k) {
            const uint32_t at = first + (spoke + k) % 4, sector = topology.sectorCorners[at];
            const uint32_t face = topology.cornerFaces[sector];
            ends[k] = topology.spokeVertices[at];
            diagonals[k] = mesh.faceVertices[cage::nextCorner(mesh, face, cage::nextCorner(mesh, face, sector))];
        }
        // Steps along the edge to the next corner, and along that to the last.
        const std::array<std::array<size_t, 4>, 4> places{
            {{0, 1, 4, 5}, {3, 7, 2, 6}, {15, 14, 11, 10}, {12, 8, 13, 9}}};
        Form &point = net[places[j][0]], &along = net[places[j][1]], &back = net[places[j][2]],
             &inner = net[places[j][3]];
        sum(point, vertex, 16.0 / 36.0);
        for (uint32_t k = 0; k < 4; ++k) {
            sum(point, ends[k], 4.0 / 36.0);
            sum(point, diagonals[k], 1.0 / 36.0);
        }
        const auto tangent = [&](Form& to, uint32_t k) {
            sum(to, vertex, 8.0 / 18.0);
            sum(to, ends[k], 4.0 / 18.0);
            sum(to, ends[(k + 1) % 4], 2.0 / 18.0);
            sum(to, ends[(k + 3) % 4], 2.0 / 18.0);
            sum(to, diagonals[k], 1.0 / 18.0);
            sum(to, diagonals[(k + 3) % 4], 1.0 / 18.0);
        };
        tangent(along, 0);
        tangent(back, 1);
        sum(inner, vertex, 4.0 / 9.0);
        sum(inner, ends[0], 2.0 / 9.0);
        sum(inner, ends[1], 2.0 / 9.0);
        sum(inner, diagonals[0], 1.0 / 9.0);
    }
    return net;
}

} // namespace supple::cpu
