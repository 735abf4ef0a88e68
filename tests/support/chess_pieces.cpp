#include "tests/support/chess_pieces.h"

#include "tests/support/meshes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace supple::test {
namespace {

/// Points on a grid of columns round the axis, and what is built from them. The axis is y.
class Lathe {
public:
    explicit Lathe(uint32_t columns) : columns_(columns) {}

    uint32_t point(double column, double radius, double height) {
        const double angle = -2.0 * std::numbers::pi * column / columns_;
        positions_.emplace_back(radius * std::cos(angle), height, radius * std::sin(angle));
        return static_cast<uint32_t>(positions_.size() - 1);
    }
    /// A point for every column.
    std::vector<uint32_t> ring(double radius, double height) {
        std::vector<uint32_t> points;
        for (uint32_t c = 0; c < columns_; ++c) {
            points.push_back(point(c, radius, height));
        }
        return points;
    }

    /// Counter-clockwise seen from outside, where columns count to the right.
    void face(std::vector<uint32_t> corners) { faces_.push_back(std::move(corners)); }
    void band(const std::vector<uint32_t>& below, const std::vector<uint32_t>& above) {
        for (uint32_t c = 0; c < columns_; ++c) {
            const uint32_t d = (c + 1) % columns_;
            face({below[c], below[d], above[d], above[c]});
        }
    }
    void fan(const std::vector<uint32_t>& ring, double height, bool up) {
        const uint32_t apex = point(0.0, 0.0, height);
        for (uint32_t c = 0; c < columns_; ++c) {
            const uint32_t d = (c + 1) % columns_;
            face(up ? std::vector<uint32_t>{ring[c], ring[d], apex} : std::vector<uint32_t>{ring[d], ring[c], apex});
        }
    }

    void crease(uint32_t a, uint32_t b, float sharpness) { creases_.push_back({a, b, sharpness}); }
    void creaseRing(const std::vector<uint32_t>& ring, float sharpness) {
        for (uint32_t c = 0; c < columns_; ++c) {
            crease(ring[c], ring[(c + 1) % columns_], sharpness);
        }
    }

    cage::Cage cage() {
        cage::Cage made = makeCage(std::move(positions_), faces_);
        made.creases = std::move(creases_);
        return made;
    }

private:
    uint32_t columns_;
    std::vector<glm::vec3> positions_;
    Faces faces_;
    std::vector<cage::Crease> creases_;
};

/// Foot, body and neck of a piece, up to a ring of the given radius and height, which is returned.
std::vector<uint32_t> turnedBody(Lathe& lathe, double radius, double height, float sharpness) {
    const std::array<std::pair<double, double>, 5> profile{
        {{1.0, 0.0}, {1.0, 0.25}, {0.6, 0.5}, {0.45, 1.3}, {0.8 * radius, height - 0.3}}};
    std::vector<uint32_t> below;
    for (const auto& [r, y] : profile) {
        const std::vector<uint32_t> ring = lathe.ring(r, y);
        if (below.empty()) {
            lathe.fan(ring, 0.0, false);
        } else {
            lathe.band(below, ring);
        }
        if (y < 0.3) {
            lathe.creaseRing(ring, sharpness);
        }
        below = ring;
    }
    const std::vector<uint32_t> top = lathe.ring(radius, height);
    lathe.band(below, top);
    return top;
}

/// The head of a bishop: rings from the neck to the top, sheared so that the cut is slanted.
struct Head {
    static constexpr uint32_t kRows = 8;
    static constexpr uint32_t kCutRow = 4; ///< between rings 4 and 5

    [[nodiscard]] static double radius(double row) {
        return 0.2 + 0.55 * std::sin(std::numbers::pi * (0.12 + 0.8 * row / kRows));
    }
    [[nodiscard]] double height(double column, double row) const {
        const double t = row / kRows;
        const double slant = 0.25 * std::sin(std::numbers::pi * t);
        return 1.9 + 1.5 * t + slant * std::cos(2.0 * std::numbers::pi * (column - middle) / columns);
    }
    uint32_t point(Lathe& lathe, double column, double row, double depth) const {
        return lathe.point(column, radius(row) - depth, height(column, row));
    }

    double columns = 0.0, middle = 0.0;
};

/// The cell of a cut in the row between `below` and `above`, column by column.
void cutRow(Lathe& lathe, const Head& head, const std::vector<uint32_t>& below, const std::vector<uint32_t>& above,
            uint32_t first, uint32_t last, BishopCut cut, float sharpness) {
    const auto columns = static_cast<uint32_t>(head.columns);
    const double row = Head::kCutRow;
    for (uint32_t c = 0; c < columns; ++c) {
        if (c < first || c >= last) {
            lathe.face({below[c], below[(c + 1) % columns], above[(c + 1) % columns], above[c]});
        }
    }
    struct Section {
        uint32_t lower, bottom, upper;
    };
    std::vector<Section> sections;
    for (uint32_t c = first + 1; c < last; ++c) {
        const bool slit = cut == BishopCut::slit;
        sections.push_back({slit ? head.point(lathe, c, row + 0.3, 0.0) : below[c],
                            head.point(lathe, c, row + 0.5, 0.25),
                            slit ? head.point(lathe, c, row + 0.7, 0.0) : above[c]});
    }
    for (size_t k = 0; k + 1 < sections.size(); ++k) {
        const Section &a = sections[k], &b = sections[k + 1];
        const uint32_t c = first + 1 + static_cast<uint32_t>(k);
        if (cut == BishopCut::slit) {
            lathe.face({below[c], below[c + 1], b.lower, a.lower});
            lathe.face({a.upper, b.upper, above[c + 1], above[c]});
            lathe.crease(a.bottom, b.bottom, sharpness);
        }
        lathe.face({a.lower, b.lower, b.bottom, a.bottom});
        lathe.face({a.bottom, b.bottom, b.upper, a.upper});
        lathe.crease(a.lower, b.lower, sharpness);
        lathe.crease(a.upper, b.upper, sharpness);
    }
    const Section &a = sections.front(), &b = sections.back();
    if (cut == BishopCut::groove) {
        lathe.face({below[first], a.lower, a.bottom, a.upper, above[first]});
        lathe.face({b.lower, below[last], above[last], b.upper, b.bottom});
        lathe.crease(below[first], a.lower, sharpness);
        lathe.crease(above[first], a.upper, sharpness);
        lathe.crease(b.lower, below[last], sharpness);
        lathe.crease(b.upper, above[last], sharpness);
        return;
    }
    const uint32_t s = head.point(lathe, first + 0.5, row + 0.5, 0.0),
                   t = head.point(lathe, last - 0.5, row + 0.5, 0.0);
    lathe.face({below[first], below[first + 1], a.lower, s});
    lathe.face({s, a.upper, above[first + 1], above[first]});
    lathe.face({below[first], s, above[first]});
    lathe.face({s, a.lower, a.bottom});
    lathe.face({s, a.bottom, a.upper});
    lathe.face({below[last - 1], below[last], t, b.lower});
    lathe.face({b.upper, t, above[last], above[last - 1]});
    lathe.face({t, below[last], above[last]});
    lathe.face({b.lower, t, b.bottom});
    lathe.face({b.bottom, t, b.upper});
    for (const auto& [tip, end] : {std::pair{s, a}, {t, b}}) {
        for (const uint32_t to : {end.lower, end.bottom, end.upper}) {
            lathe.crease(tip, to, sharpness);
        }
    }
}

} // namespace

cage::Cage rook(const RookShape& shape) {
    const uint32_t period = shape.merlonColumns + shape.gapColumns;
    const uint32_t columns = shape.merlons * period;
    const float sharp = shape.sharpness;
    Lathe lathe(columns);
    std::vector<uint32_t> outer = turnedBody(lathe, 0.8, 2.0 - shape.support, sharp);
    if (shape.support > 0.0) {
        const std::vector<uint32_t> below = std::exchange(outer, lathe.ring(0.8, 2.0));
        lathe.band(below, outer);
    }
    const std::vector<uint32_t> inner = lathe.ring(0.5, 2.0), well = lathe.ring(0.5, 1.75);
    std::vector<uint32_t> outerTop(columns, cage::kNone), innerTop(columns, cage::kNone);
    for (uint32_t c = 0; c < columns; ++c) {
        if (c % period <= shape.merlonColumns) {
            outerTop[c] = lathe.point(c, 0.8, 2.4);
            innerTop[c] = lathe.point(c, 0.5, 2.4);
        }
    }
    for (uint32_t c = 0; c < columns; ++c) {
        const uint32_t d = (c + 1) % columns;
        lathe.face({well[d], well[c], inner[c], inner[d]});
        const bool merlon = c % period < shape.merlonColumns;
        if (merlon || shape.rings) {
            lathe.crease(merlon ? outerTop[c] : outer[c], merlon ? outerTop[d] : outer[d], sharp);
            lathe.crease(merlon ? innerTop[c] : inner[c], merlon ? innerTop[d] : inner[d], sharp);
        }
        if (!merlon) {
            lathe.face({outer[c], outer[d], inner[d], inner[c]});
            lathe.crease(outer[c], outer[d], sharp);
            lathe.crease(inner[c], inner[d], sharp);
            continue;
        }
        if (shape.rings) {
            lathe.crease(outer[c], outer[d], sharp);
            lathe.crease(inner[c], inner[d], sharp);
        }
        lathe.face({outer[c], outer[d], outerTop[d], outerTop[c]});
        lathe.face({outerTop[c], outerTop[d], innerTop[d], innerTop[c]});
        lathe.face({inner[d], inner[c], innerTop[c], innerTop[d]});
        const bool begins = c % period == 0, endsHere = c % period + 1 == shape.merlonColumns;
        for (const auto& [at, side] : {std::pair{c, begins}, {d, endsHere}}) {
            if (!side) {
                continue;
            }
            lathe.face(at == c ? std::vector<uint32_t>{inner[at], outer[at], outerTop[at], innerTop[at]}
                               : std::vector<uint32_t>{outer[at], inner[at], innerTop[at], outerTop[at]});
            lathe.crease(outer[at], inner[at], sharp);
            lathe.crease(outer[at], outerTop[at], sharp);
            lathe.crease(inner[at], innerTop[at], sharp);
            lathe.crease(outerTop[at], innerTop[at], sharp);
        }
    }
    lathe.creaseRing(well, sharp);
    lathe.fan(well, 1.75, true);
    return lathe.cage();
}

cage::Cage bishop(uint32_t columns, uint32_t span, BishopCut cut, float sharpness) {
    Lathe lathe(columns);
    const uint32_t first = 1, last = first + span;
    const Head head{static_cast<double>(columns), 0.5 * (first + last)};
    std::vector<uint32_t> below = turnedBody(lathe, 0.5, 1.8, sharpness);
    lathe.creaseRing(below, sharpness);
    for (uint32_t row = 0; row <= Head::kRows; ++row) {
        std::vector<uint32_t> ring;
        for (uint32_t c = 0; c < columns; ++c) {
            ring.push_back(head.point(lathe, c, row, 0.0));
        }
        if (row == Head::kCutRow + 1) {
            cutRow(lathe, head, below, ring, first, last, cut, sharpness);
        } else {
            lathe.band(below, ring);
        }
        below = ring;
    }
    lathe.fan(below, head.height(0.0, Head::kRows) + 0.1, true);
    return lathe.cage();
}

const std::vector<ChessPiece>& chessPieces() {
    static const std::vector<ChessPiece> kAll = [] {
        std::vector<ChessPiece> all;
        for (const float sharpness : {cage::kHardSharpness, 4.0f, 2.0f, 1.0f}) {
            const std::string suffix = ", sharpness " + std::to_string(static_cast<int>(sharpness));
            for (const auto& [kind, rings, support] : {std::tuple{"rook ", false, 0.0},
                                                       {"ringed rook ", true, 0.0},
                                                       {"supported rook ", false, 0.05},
                                                       {"supported ringed rook ", true, 0.02}}) {
                for (const auto& [merlons, merlonColumns, gapColumns] :
                     {std::tuple{3u, 2u, 2u}, {4u, 1u, 1u}, {5u, 2u, 1u}}) {
                    const std::string size = std::to_string(merlons) + " x " + std::to_string(merlonColumns) + " + " +
                                             std::to_string(gapColumns);
                    all.push_back({kind + size + suffix, merlons * (merlonColumns + gapColumns),
                                   rook({merlons, merlonColumns, gapColumns, rings, support, sharpness})});
                }
            }
            for (const uint32_t columns : {8u, 12u, 16u}) {
                const std::string size = std::to_string(columns);
                all.push_back({"bishop with a groove " + size + suffix, columns,
                               bishop(columns, columns / 2, BishopCut::groove, sharpness)});
                all.push_back({"bishop with a slit " + size + suffix, columns,
                               bishop(columns, columns / 2, BishopCut::slit, sharpness)});
            }
        }
        return all;
    }();
    return kAll;
}

} // namespace supple::test
