#include "surface/fragments/class_check.h"

#include "shaders/shared/subdivision.h"
#include "surface/grid.h"
#include "surface/subdivision/pattern.h"
#include "surface/table_check_common.h"

#include <algorithm>

namespace supple::surface::fragments {

using namespace subdivision;

namespace {

using namespace shared;

/// How often the tables may be followed. The most that was found is 0.97: sharp and smooth fans of one shape have their
/// pattern in common, and all steps of a fan.
constexpr uint64_t kMostFollowed = 4;
/// Kernels tell a lane's fragment by a division of floats, which is exact up to here.
constexpr uint64_t kMostFragments = 1u << 21;
constexpr uint64_t kMostPoints = 0xFFFE; ///< the last number of 16 bits is none

constexpr uint32_t kSourcesOfRule[] = {1, 6, 4, 0}; // by rule

uint32_t half(std::span<const uint32_t> words, uint32_t k) {
    return words[k / 2] >> 16 * (k % 2) & 0xFFFFu;
}

} // namespace

bool Followed::add(uint64_t elements) {
    elements_ += elements;
    return check_.require(elements_ <= kMostFollowed * (check_.tables().words.size() / 4),
                          "classes have too much in common");
}

bool Followed::elements(uint64_t first, uint64_t count) {
    return check_.elements(first, count) && add(count);
}

bool Followed::words(uint64_t first, uint64_t count) {
    return check_.words(first, count) && add((count + 3) / 4);
}

bool ScratchRuns::take(uint32_t run, uint64_t points) {
    if (!check_.require(run == next_, "points of the scratch buffer do not follow each other")) {
        return false;
    }
    next_ += points;
    return true;
}

ClassCheck::ClassCheck(TableCheck& check, Followed& followed, uint32_t header)
    : check_(check), followed_(followed), all_(check.tables().fragments), header_(header) {}

bool ClassCheck::run(ScratchRuns& runs) {
    check_.begin("headers of classes");
    if (!readHeader() || !findShape()) {
        return false;
    }
    for (uint32_t step = 1; step <= last(); ++step) {
        if (!runs.take(level(step).run, uint64_t{level(step).points} * fragments_)) {
            return false;
        }
    }
    check_.begin("pattern rows");
    for (uint32_t step = 1; step <= last(); ++step) {
        if (!followRows(step)) {
            return false;
        }
    }
    return followLimitRows() && followFragments() && followMasks() && followCentreSteps();
}

uint32_t ClassCheck::sharedPoints() const {
    return level(last()).points + (last() > 0 ? level(last() - 1).points : 0);
}

bool ClassCheck::readHeader() {
    if (!followed_.elements(header_, kClassHeaderElements + uint64_t{all_.steps} + 1)) {
        return false;
    }
    const std::span<const uint32_t> own = check_.element(header_), lists = check_.element(header_ + uint64_t{1}),
                                    more = check_.element(header_ + uint64_t{2});
    fragments_ = own[0];
    sharp_ = (own[1] & kSharpClass) != 0;
    sectors_ = own[1] & ~kSharpClass;
    net_ = own[2];
    sharpness_ = own[3];
    patches_ = lists[0];
    masks_ = lists[1];
    centreSteps_ = lists[2];
    limitRows_ = {more[2], more[3]};
    for (uint32_t step = 0; step <= all_.steps; ++step) {
        const std::span<const uint32_t> level = check_.element(header_ + uint64_t{kClassHeaderElements} + step);
        levels_.push_back({level[0], level[1], level[2], level[3]});
    }
    return check_.require(fragments_ > 0, "a class without fragments") &&
           check_.within(fragments_, 0, kMostFragments, "fragments") &&
           check_.require(sectors_ > 0, "a fragment without sectors") &&
           check_.within(sectors_, 0, kMostPoints, "sectors");
}

/// Whether it is of fans, and as many points as these have at every step.
bool ClassCheck::findShape() {
    const auto fan = [&](bool open, uint32_t step) {
        return pointCount({Subdivision::catmullClark, sectors_, open}, (1u << step) + 1);
    };
    open_ = level(0).points == fan(true, 0);
    spokes_ = sectors_ + (open_ ? 1 : 0);
    for (uint32_t step = 0; step <= last(); ++step) {
        const uint32_t points = level(step).points;
        if (!check_.require(points == fan(open_, step), "points of no fan") ||
            !check_.within(points, 0, kMostPoints, "points")) {
            return false;
        }
    }
    return true;
}

bool ClassCheck::isPoint(uint64_t point, uint32_t step) {
    return check_.within(point, 1, level(step).points, "points");
}

bool ClassCheck::points(std::span<const uint32_t> halves, uint32_t count, uint32_t step) {
    return count == 0 || isPoint(largestHalf(halves.data(), count), step);
}

bool ClassCheck::followRows(uint32_t step) {
    const Level& own = level(step);
    if (!followed_.elements(own.rows, own.points)) {
        return false;
    }
    for (uint64_t row = own.rows; row < uint64_t{own.rows} + own.points; ++row) {
        if (!followRow(check_.element(row), step)) {
            return false;
        }
    }
    return true;
}

bool ClassCheck::followRow(std::span<const uint32_t> row, uint32_t step) {
    const uint32_t packed = half(row, 7), rule = packed & 3u, spoke = packed >> 2; // 1 + spoke, or 0
    if ((sharp_ && !check_.within(0, spoke, spokes_, "spokes")) || !points(row, kSourcesOfRule[rule], step - 1)) {
        return false;
    }
    if (rule == kCentreRule) { // the points of its first ring
        return isPoint(uint64_t{2} * sectors_, step - 1);
    }
    if (rule != kVertexRule) {
        return true;
    }
    const uint64_t neighbours = uint64_t{level(step - 1).neighbours} + half(row, 0);
    return check_.elements(neighbours, 1) && points(check_.element(neighbours), 8, step - 1);
}

bool ClassCheck::followLimitRows() {
    check_.begin("limit rows");
    const uint32_t samples = sampleCount(Domain::quad, check_.tables().rate);
    if (!check_.require(limitRows_.count == uint64_t{sectors_} * samples, "not as many as samples") ||
        !followed_.elements(limitRows_.table, uint64_t{2} * limitRows_.count)) {
        return false;
    }
    for (uint64_t row = 0; row < limitRows_.count; ++row) {
        const std::span<const uint32_t> place = check_.element(limitRows_.table + 2 * row + 1);
        if (!points(check_.element(limitRows_.table + 2 * row), 8, last()) || !isPoint(place[0], last()) ||
            (sharp_ && !check_.within(0, place[1], spokes_, "spokes")) ||
            !check_.within(place[2] & kSectorMask, 1, sectors_, "sectors") ||
            !check_.within(place[3], 1, samples, "samples")) {
            return false;
        }
    }
    return true;
}

/// The vertices and patches of every fragment. Sharpness is a number.
bool ClassCheck::followFragments() {
    check_.begin("nets of fragments");
    const uint64_t net = uint64_t{level(0).points} * fragments_, patches = uint64_t{sectors_} * fragments_;
    if (!followed_.words(net_, net)) {
        return false;
    }
    const std::span words(check_.tables().words);
    for (const uint32_t vertex : words.subspan(net_, net)) {
        if (!check_.pool(vertex)) {
            return false;
        }
    }
    check_.begin("patches of fragments");
    if (!followed_.words(patches_, patches)) {
        return false;
    }
    for (const uint32_t patch : words.subspan(patches_, patches)) {
        if (patch != kNoPatch && !check_.within(patch, 1, check_.tables().patches.size(), "patches")) {
            return false;
        }
    }
    check_.begin("sharpness of fragments");
    return !sharp_ || check_.words(sharpness_, uint64_t{spokes_} * fragments_);
}

/// For every sector that of its run: how far kernels go round the first ring, and from which spokes.
bool ClassCheck::followMasks() {
    check_.begin("masks");
    const uint64_t count = uint64_t{sectors_} * fragments_;
    if (!followed_.words(masks_, count)) {
        return false;
    }
    const uint32_t ring = sectors_ + spokes_;
    for (const uint32_t mask : std::span(check_.tables().words).subspan(masks_, count)) {
        if (!check_.elements(mask, uint64_t{1} + ring)) {
            return false;
        }
        const std::span<const uint32_t> head = check_.element(mask);
        if (!check_.require(head[3] == ring, "another ring than the fragment's") ||
            !check_.within(head[1], 1, spokes_, "spokes") || !check_.within(head[2], 0, spokes_, "sectors")) {
            return false;
        }
    }
    return true;
}

bool ClassCheck::followCentreSteps() {
    check_.begin("centre steps");
    const uint64_t count = uint64_t{all_.steps} * fragments_;
    if (!sharp_) {
        return true;
    }
    if (!followed_.elements(centreSteps_, count)) {
        return false;
    }
    for (uint64_t step = centreSteps_; step < centreSteps_ + count; ++step) {
        const std::span<const uint32_t> centre = check_.element(step);
        if (!check_.within(std::max(centre[2], centre[3]), 1, spokes_, "spokes")) {
            return false;
        }
    }
    return true;
}

bool ClassCheck::followCells(const Section& cells, uint32_t step) {
    check_.begin("cells");
    if (!followed_.elements(cells.table, cells.count)) {
        return false;
    }
    constexpr uint32_t kTargets = 6; // the last makes nothing
    for (uint64_t c = cells.table; c < uint64_t{cells.table} + cells.count; ++c) {
        const std::span<const uint32_t> cell = check_.element(c);
        const uint32_t point = half(cell, kCellTargets);
        const uint64_t neighbours = uint64_t{level(step - 1).neighbours} + point;
        if (!isPoint(point, step - 1) || !check_.elements(neighbours, 1) ||
            !points(check_.element(neighbours), 8, step - 1)) {
            return false;
        }
        for (uint32_t k = 0; k < kTargets; ++k) {
            if (half(cell, k) != kNoTarget && !isPoint(half(cell, k), step)) {
                return false;
            }
        }
    }
    return true;
}

bool ClassCheck::followList(uint32_t firstWord, uint32_t count, uint32_t step) {
    check_.begin("row lists");
    if (!followed_.words(firstWord, count)) {
        return false;
    }
    for (const uint32_t row : std::span(check_.tables().words).subspan(firstWord, count)) {
        if (!isPoint(row, step)) {
            return false;
        }
    }
    return true;
}

bool ClassCheck::followStrips(const Section& strips) {
    check_.begin("strips");
    if (!followed_.elements(strips.table, strips.count)) {
        return false;
    }
    const uint32_t samples = limitRows_.count / sectors_;
    for (uint64_t s = strips.table; s < uint64_t{strips.table} + strips.count; ++s) {
        const std::span<const uint32_t> strip = check_.element(s);
        const uint64_t columns = strip[1];
        if (!check_.within(strip[2], 1, sectors_, "sectors") || !followed_.elements(strip[0], columns)) {
            return false;
        }
        for (uint64_t c = 0; c < columns; ++c) {
            const std::span<const uint32_t> column = check_.element(strip[0] + c);
            // The outermost columns are no samples.
            const bool isSample = c > 0 && c + 1 < columns && column[2] != kNoSample;
            if (!points(column, 3, last()) || (isSample && !check_.within(column[1] >> 16, 1, samples, "samples"))) {
                return false;
            }
        }
    }
    return true;
}

} // namespace supple::surface::fragments
