#include "tests/support/mush_reference.h"

#include "cage/smoothing.h"
#include "tests/support/joint_factors.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <set>

namespace supple::test {

namespace {

using Column = std::vector<double>;

/// (D + diag(m lambda) L) x = D b, again and again.
class Smoother {
public:
    explicit Smoother(const cage::Character& character)
        : neighbors_(character.cage.positions.size()), mask_(neighbors_.size(), 1.0),
          smoothing_(cage::smoothingOf(character)) {
        const cage::Cage& cage = character.cage;
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            const uint32_t first = cage.faceStarts[f], count = cage.faceStarts[f + 1] - first;
            for (uint32_t c = 0; c < count; ++c) {
                const uint32_t a = cage.faceVertices[first + c], b = cage.faceVertices[first + (c + 1) % count];
                neighbors_[a].insert(b);
                neighbors_[b].insert(a);
            }
        }
        std::copy(character.weights.mushMask.begin(), character.weights.mushMask.end(), mask_.begin());
    }

    [[nodiscard]] bool moves(size_t v) const { return mask_[v] > 0.0 && !neighbors_[v].empty(); }
    [[nodiscard]] Column smoothed(Column x) const {
        for (uint32_t i = 0; i < smoothing_.iterations; ++i) {
            x = solved(x);
        }
        return x;
    }

private:
    /// Gauss and Seidel's way, until nothing changes.
    [[nodiscard]] Column solved(const Column& b) const {
        Column x = b;
        double change = 1.0, largest = 0.0;
        for (const double value : b) {
            largest = std::max(largest, std::abs(value));
        }
        while (change > 1e-15 * largest) {
            change = 0.0;
            for (size_t v = 0; v < x.size(); ++v) {
                if (!moves(v)) {
                    continue;
                }
                const double degree = static_cast<double>(neighbors_[v].size());
                const double pull = mask_[v] * static_cast<double>(smoothing_.lambda);
                double sum = 0.0;
                for (const uint32_t other : neighbors_[v]) {
                    sum += x[other];
                }
                const double value = (degree * b[v] + pull * sum) / (degree * (1.0 + pull));
                change = std::max(change, std::abs(value - x[v]));
                x[v] = value;
            }
        }
        return x;
    }

    std::vector<std::set<uint32_t>> neighbors_;
    Column mask_;
    cage::Smoothing smoothing_;
};

void add(const MushMoments& more, MushMoments& sum) {
    sum.weight += more.weight;
    sum.offset += more.offset;
    sum.spread += more.spread;
}

/// The heaviest joint takes what is dropped, and a hundred-thousandth of the whole, so that no vertex is flat.
void cutBelow(double cut, MushVertex& vertex) {
    for (const auto& [joint, moments] : vertex.joints) {
        const double most = vertex.joints.at(vertex.heaviest).weight;
        if (moments.weight > most) {
            vertex.heaviest = joint;
        }
    }
    MushMoments total, dropped;
    for (auto i = vertex.joints.begin(); i != vertex.joints.end();) {
        add(i->second, total);
        const bool drop = i->second.weight < cut && i->first != vertex.heaviest;
        if (drop) {
            add(i->second, dropped);
        }
        i = drop ? vertex.joints.erase(i) : std::next(i);
    }
    add(dropped, vertex.joints[vertex.heaviest]);
    const double size = total.spread[0][0] + total.spread[1][1] + total.spread[2][2];
    vertex.joints[vertex.heaviest].spread += glm::dmat3(1e-5 * size);
}

/// Of Davenport's form, by Jacobi's rotations.
glm::dmat3 bestRotation(const glm::dmat3& m) {
    const double xx = m[0][0], xy = m[1][0], xz = m[2][0], yx = m[0][1], yy = m[1][1], yz = m[2][1], zx = m[0][2],
                 zy = m[1][2], zz = m[2][2];
    double form[4][4] = {{xx + yy + zz, zy - yz, xz - zx, yx - xy},
                         {zy - yz, xx - yy - zz, xy + yx, xz + zx},
                         {xz - zx, xy + yx, yy - xx - zz, yz + zy},
                         {yx - xy, xz + zx, yz + zy, zz - xx - yy}};
    double vectors[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (int p = 0; p < 3; ++p) {
            for (int q = p + 1; q < 4; ++q) {
                const double angle = 0.5 * std::atan2(2.0 * form[p][q], form[q][q] - form[p][p]);
                const double c = std::cos(angle), s = std::sin(angle);
                for (auto* const row : {&form, &vectors}) {
                    for (auto& k : *row) {
                        const double a = k[p], b = k[q];
                        k[p] = c * a - s * b;
                        k[q] = s * a + c * b;
                    }
                }
                for (int k = 0; k < 4; ++k) {
                    const double a = form[p][k], b = form[q][k];
                    form[p][k] = c * a - s * b;
                    form[q][k] = s * a + c * b;
                }
            }
        }
    }
    int best = 0;
    for (int k = 1; k < 4; ++k) {
        best = form[k][k] > form[best][best] ? k : best;
    }
    return glm::mat3_cast(
        glm::normalize(glm::dquat(vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best])));
}

} // namespace

std::vector<MushVertex> mushOneByOne(const cage::Character& character, double cut) {
    const Smoother smoother(character);
    const size_t count = character.cage.positions.size();
    const auto position = [&](size_t v) { return glm::dvec3(character.cage.positions[v]); };
    std::vector<MushVertex> mush(count);
    for (int axis = 0; axis < 3; ++axis) {
        Column x(count);
        for (size_t v = 0; v < count; ++v) {
            x[v] = position(v)[axis];
        }
        x = smoother.smoothed(x);
        for (size_t v = 0; v < count; ++v) {
            mush[v].place[axis] = x[v];
        }
    }
    for (uint32_t joint = 0; joint < character.skin.joints.size(); ++joint) {
        Column weights(count, 0.0);
        for (size_t v = 0; v < count; ++v) {
            for (uint32_t i = character.weights.starts[v]; i < character.weights.starts[v + 1]; ++i) {
                const cage::Influence& own = character.weights.influences[i];
                weights[v] += own.joint == joint ? static_cast<double>(own.weight) : 0.0;
            }
        }
        // Moments of the coordinates (x, y, z, 1), two at a time.
        std::vector<Column> moments(16);
        for (int a = 0; a < 4; ++a) {
            for (int b = a; b < 4; ++b) {
                Column own = weights;
                for (size_t v = 0; v < count; ++v) {
                    const glm::dvec4 at(position(v), 1.0);
                    own[v] *= at[a] * at[b];
                }
                moments[static_cast<size_t>(4 * a + b)] = smoother.smoothed(own);
            }
        }
        for (size_t v = 0; v < count; ++v) {
            const auto moment = [&](int a, int b) {
                return moments[static_cast<size_t>(4 * std::min(a, b) + std::max(a, b))][v];
            };
            MushMoments own;
            own.weight = moment(3, 3);
            const glm::dvec3 &p = mush[v].place, first(moment(0, 3), moment(1, 3), moment(2, 3));
            own.offset = first - own.weight * p;
            for (int a = 0; a < 3; ++a) {
                for (int b = 0; b < 3; ++b) {
                    own.spread[a][b] = moment(a, b) - first[a] * p[b] - p[a] * first[b] + own.weight * p[a] * p[b];
                }
            }
            if (own.weight > 1e-13) {
                mush[v].joints[joint] = own;
            }
        }
    }
    for (size_t v = 0; v < count; ++v) {
        mush[v].smoothed = smoother.moves(v);
        mush[v].heaviest = mush[v].joints.begin()->first;
        cutBelow(mush[v].smoothed ? cut : 0.0, mush[v]);
    }
    return mush;
}

std::vector<MushVertex> mushOf(const skinning::DeltaMush& mush) {
    std::vector<MushVertex> vertices(mush.places.size());
    for (size_t v = 0; v < vertices.size(); ++v) {
        MushVertex& own = vertices[v];
        own.smoothed = mush.places[v].w != 0.0f;
        own.place = glm::dvec3(mush.places[v]);
        own.heaviest = mush.influences[mush.starts[v]].joint;
        for (uint32_t i = mush.starts[v]; i < mush.starts[v + 1]; ++i) {
            const skinning::MushInfluence& from = mush.influences[i];
            const std::array<float, 6>& s = from.spread;
            MushMoments moments{static_cast<double>(from.weight), glm::dvec3(from.offset),
                                glm::dmat3(s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5])};
            add(moments, own.joints[from.joint]);
        }
    }
    return vertices;
}

std::vector<glm::dvec3> skinByMush(std::span<const glm::dvec3> positions, std::span<const MushVertex> mush,
                                   std::span<const skinning::Affine> palette, bool light, const glm::dmat4& transform) {
    const std::vector<JointFactors> factors = factorsOf(palette);
    std::vector<glm::dvec3> skinned;
    for (size_t v = 0; v < positions.size(); ++v) {
        const MushVertex& vertex = mush[v];
        const glm::dvec3 place = vertex.smoothed ? vertex.place : positions[v];
        const auto moved = [&](const JointFactors& joint) {
            return joint.rotation * (joint.stretch * place) + joint.translation;
        };
        const JointFactors& heaviest = factors[vertex.heaviest];
        const glm::dquat side = glm::quat_cast(heaviest.rotation);
        glm::dvec3 sum(0.0);
        glm::dmat3 turned(0.0), shifted(0.0), stretch(0.0);
        glm::dquat blend{0.0, 0.0, 0.0, 0.0};
        for (const auto& [number, moments] : vertex.joints) {
            const JointFactors& joint = factors[number];
            const glm::dmat3 matrix = joint.rotation * joint.stretch;
            const glm::dquat rotation = glm::quat_cast(joint.rotation);
            sum += moments.weight * moved(joint) + matrix * moments.offset;
            stretch += moments.weight * joint.stretch;
            turned += joint.rotation * moments.spread;
            shifted += glm::outerProduct(moved(joint) - moved(heaviest), moments.offset);
            blend = blend + rotation * (glm::dot(rotation, side) < 0.0 ? -moments.weight : moments.weight);
        }
        const double scale = (stretch[0][0] + stretch[1][1] + stretch[2][2]) / 3.0;
        glm::dmat3 rotation(1.0);
        if (vertex.smoothed) {
            rotation = light ? glm::mat3_cast(glm::normalize(blend))
                             : bestRotation(std::abs(scale) * turned + (scale < 0.0 ? -1.0 : 1.0) * shifted);
        }
        skinned.emplace_back(transform * glm::dvec4(sum + rotation * (stretch * (positions[v] - place)), 1.0));
    }
    return skinned;
}

} // namespace supple::test
