// Values at the vertices of a cage, smoothed over its edges.
#pragma once

#include "cage/character.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::skinning {

/// x becomes (1 + m lambda D^-1 L)^-iterations x, where D has the vertices' degrees, L = D - A is the Laplacian of the
/// graph of the polygons' edges, and m is the mask. What comes out at a vertex is a mean of what went in: no weight is
/// negative, and their sum is 1. A vertex whose mask is 0 keeps what it has.
///
/// The power is a function of the walk W = 1 - m D^-1 L, which goes from a vertex to its neighbors: f(w) = (1 + lambda
/// (1 - w))^-iterations. The eigenvalues of W lie between -1 and 1, so a sum of Chebyshev polynomials of W is as close
/// to it as one likes. A polynomial of degree k reaches k edges far, so that smoothing a few values takes no longer
/// for a large cage than for a small one.
class CageSmoother {
public:
    /// So many values are smoothed at once.
    static constexpr size_t kColumns = 10;
    using Values = std::array<double, kColumns>;

    CageSmoother(const cage::Character& character, const cage::Smoothing& smoothing);

    /// Vertices of one place and one skin are one node, so that parts do not come apart that are not sewn together.
    [[nodiscard]] uint32_t nodeOf(uint32_t vertex) const { return nodes_[vertex]; }
    [[nodiscard]] uint32_t nodeCount() const { return static_cast<uint32_t>(vertices_.size()); }
    /// The first vertex of a node.
    [[nodiscard]] uint32_t vertexOf(uint32_t node) const { return vertices_[node]; }
    /// False: the node keeps what it has.
    [[nodiscard]] bool moves(uint32_t node) const { return shares_[node] > 0.0; }

    /// How many products it takes to smooth what is 0 but at some nodes; for one column.
    [[nodiscard]] uint64_t work(std::span<const uint32_t> nodes);
    /// Smooths what is 0 but at some nodes, which are different from each other; `values`: theirs. The nodes where the
    /// result may be something else than 0, in the order in which the edges reach them; see smoothed().
    std::span<const uint32_t> smooth(std::span<const uint32_t> nodes, std::span<const Values> values);
    /// What smooth() has made of a node that it has named.
    [[nodiscard]] const Values& smoothed(uint32_t node) const { return sums_[node]; }

private:
    void findNodes(const cage::Character& character);
    void findEdges(const cage::Cage& cage);
    void reach(std::span<const uint32_t> nodes);
    void forget();

    std::vector<uint32_t> nodes_;    ///< by vertex
    std::vector<uint32_t> vertices_; ///< by node
    std::vector<uint32_t> starts_, neighbors_;
    std::vector<double> shares_;       ///< by node: the mask over the degree
    std::vector<double> coefficients_; ///< of the Chebyshev polynomials
    // What smooth() works with:
    std::vector<uint32_t> reached_, ends_; ///< nodes, ring by ring; how many there are up to a ring
    std::vector<uint8_t> isReached_;
    std::vector<Values> before_, now_, sums_; ///< by node: two polynomials, and their sum; 0 but where reached
};

} // namespace supple::skinning
