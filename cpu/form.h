// Points as combinations of a cage's vertices. Constructions are written for any kind of point: with positions they
// give positions, with forms the weights that a pose does not change.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace supple::surface {

/// A linear combination of vertices, in double.
class Form {
public:
    struct Entry {
        uint32_t vertex = 0;
        double weight = 0.0;
    };

    Form() = default;
    /// A sum of nothing: constructions begin their sums with Point(0).
    explicit Form(double /*zero*/) {}
    [[nodiscard]] static Form ofVertex(uint32_t vertex) {
        Form form;
        form.entries_.push_back({vertex, 1.0});
        return form;
    }

    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; } ///< rising by vertex

    Form& operator+=(const Form& other) { return addTimes(other, 1.0); }
    Form& operator-=(const Form& other) { return addTimes(other, -1.0); }
    Form& operator*=(double factor) {
        for (Entry& entry : entries_) {
            entry.weight *= factor;
        }
        return *this;
    }
    Form& addTimes(const Form& other, double factor) {
        std::vector<Entry> sum;
        sum.reserve(entries_.size() + other.entries_.size());
        auto own = entries_.begin();
        for (const Entry& entry : other.entries_) {
            for (; own != entries_.end() && own->vertex < entry.vertex; ++own) {
                sum.push_back(*own);
            }
            const double before = own != entries_.end() && own->vertex == entry.vertex ? (own++)->weight : 0.0;
            sum.push_back({entry.vertex, before + factor * entry.weight});
        }
        sum.insert(sum.end(), own, entries_.end());
        entries_ = std::move(sum);
        return *this;
    }

private:
    std::vector<Entry> entries_;
};

[[nodiscard]] inline Form operator+(Form a, const Form& b) {
    return std::move(a += b);
}
[[nodiscard]] inline Form operator-(Form a, const Form& b) {
    return std::move(a -= b);
}
[[nodiscard]] inline Form operator*(Form a, double factor) {
    return std::move(a *= factor);
}
[[nodiscard]] inline Form operator*(double factor, Form a) {
    return std::move(a *= factor);
}
[[nodiscard]] inline Form operator/(Form a, double divisor) {
    return std::move(a *= 1.0 / divisor);
}

/// What weights of a kind of point are.
template <class Point>
struct ScalarOfPoint;
template <class T>
struct ScalarOfPoint<glm::vec<3, T>> {
    using Type = T;
};
template <>
struct ScalarOfPoint<Form> {
    using Type = double;
};
template <class Point>
using ScalarOf = typename ScalarOfPoint<Point>::Type;

/// Along a x b, of unit length, or zero.
template <class T>
[[nodiscard]] glm::vec<3, T> unitCross(const glm::vec<3, T>& a, const glm::vec<3, T>& b) {
    const glm::vec<3, T> v = glm::cross(a, b);
    const T length = glm::length(v);
    return length > T(0) ? v / length : glm::vec<3, T>(T(0));
}
/// Normals are no combinations of vertices: forms have none.
[[nodiscard]] inline Form unitCross(const Form& /*a*/, const Form& /*b*/) {
    return {};
}

} // namespace supple::surface
