#include "runtime/cpu_group.h"

#include "runtime/part_schemes.h"
#include "runtime/prepare.h"
#include "surface/grid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numeric>

namespace supple::runtime {

namespace {

constexpr uint32_t kPointsPerJob = 1024;
/// Points that are found and evaluated at a time: stacks of jobs may be small.
constexpr uint32_t kPointsAtATime = 32;
constexpr uint32_t kPatchesPerJob = 64;
/// Weights of floats add up to 1 and a little.
constexpr double kWeightSlack = 1e-6;

const char* faultOf(const SuppleSurfacePoint& point, uint32_t sides) {
    if (!std::isfinite(point.a) || !std::isfinite(point.b)) {
        return "a or b is not finite";
    }
    if (sides > 4 ? point.side >= sides : point.side != 0) {
        return "the face has no such side";
    }
    const double a = point.a, b = point.b;
    const bool below = a < -kWeightSlack || b < -kWeightSlack;
    const bool beyond = sides == 4 ? a > 1.0 + kWeightSlack || b > 1.0 + kWeightSlack : a + b > 1.0 + kWeightSlack;
    return below || beyond ? "a and b do not lie in the face" : nullptr;
}

/// Within the face to the last bit.
cpu::FacePoint clamped(const SuppleSurfacePoint& point, uint32_t sides) {
    cpu::FacePoint inside{point.face, point.side, std::clamp<double>(point.a, 0.0, 1.0),
                          std::clamp<double>(point.b, 0.0, 1.0)};
    if (sides != 4 && inside.a + inside.b > 1.0) {
        const double sum = inside.a + inside.b;
        inside.a /= sum;
        inside.b = 1.0 - inside.a;
    }
    return inside;
}

void write(const cpu::SurfaceJet& jet, SuppleSurfaceJet& out) {
    const auto put = [](const glm::dvec3& from, float* to) {
        for (int axis = 0; axis < 3; ++axis) {
            to[axis] = static_cast<float>(from[axis]);
        }
    };
    put(jet.position, out.position);
    put(jet.du, out.du), put(jet.dv, out.dv);
    put(jet.duu, out.duu), put(jet.duv, out.duv), put(jet.dvv, out.dvv);
}

/// How many patches of each domain a surface has.
std::array<uint64_t, surface::kDomainCount> domainsOf(const cpu::Surface& surface) {
    std::array<uint64_t, surface::kDomainCount> counts{};
    for (uint32_t p = 0; p < surface.patches().size(); ++p) {
        ++counts[static_cast<size_t>(surface.domainOf(p))];
    }
    return counts;
}

/// The triangles of one patch, of all domains at a rate.
class GridsByDomain {
public:
    explicit GridsByDomain(uint32_t rate) : rate_(rate) {}

    [[nodiscard]] const std::vector<uint16_t>& of(surface::Domain domain) {
        std::vector<uint16_t>& grid = grids_[static_cast<size_t>(domain)];
        if (grid.empty()) {
            grid = surface::gridIndices(domain, rate_);
        }
        return grid;
    }

private:
    uint32_t rate_;
    std::array<std::vector<uint16_t>, surface::kDomainCount> grids_;
};

} // namespace

Result<std::shared_ptr<const CpuGroup>> CpuGroup::create(std::shared_ptr<const Prepared> prepared,
                                                         const SuppleGroupDesc& desc) {
    auto group = std::make_shared<CpuGroup>();
    group->prepared_ = std::move(prepared);
    group->partOfFace_.assign(group->cage().faceCount(), 0);
    group->faceInPart_.assign(group->cage().faceCount(), 0);
    if (desc.scheme == SUPPLE_SCHEME_CAGE) {
        group->addCage();
        return std::shared_ptr<const CpuGroup>(std::move(group));
    }
    const Result<std::vector<SchemeParts>> schemes = schemesOf(*group->prepared_, desc);
    if (!schemes) {
        return schemes.error();
    }
    for (const SchemeParts& own : *schemes) {
        if (const Status added = group->addPart(desc, own.scheme, own.chosen, own.parts); !added) {
            return added.error();
        }
    }
    return std::shared_ptr<const CpuGroup>(std::move(group));
}

Status CpuGroup::addPart(const SuppleGroupDesc& desc, SuppleScheme scheme, bool chosen,
                         const std::vector<uint32_t>& parts) {
    const cage::Character& character = prepared_->character;
    Part& part = parts_.emplace_back();
    part.scheme = scheme;
    part.piece = parts.size() == character.parts.size() ? nullptr : prepared_->pieceOf(parts);
    // The tables say which patches there are, in the order of the device.
    const Result<PlannedSurface> planned =
        plannedSurface(*prepared_, {desc, std::nullopt}, {scheme, chosen, parts}, part.piece, {.wide = true});
    if (!planned) {
        return planned.error();
    }
    std::shared_ptr<const PreparedTables> tables = prepared_->findServing(planned->recipe, part.piece.get());
    if (tables == nullptr) {
        const auto built = prepared_->build(planned->recipe, part.piece);
        if (!built) {
            return built.error();
        }
        tables = *built;
    }
    part.patches = tables->tables.patches;
    std::vector<surface::PatchInfo> patches = part.patches;
    if (part.piece != nullptr) {
        const cage::CagePiece& piece = part.piece->of;
        const auto inPiece = [](const std::vector<uint32_t>& of, uint32_t number) {
            return static_cast<uint32_t>(std::lower_bound(of.begin(), of.end(), number) - of.begin());
        };
        for (surface::PatchInfo& patch : patches) {
            patch.face = inPiece(piece.faces, patch.face);
            for (uint32_t& corner : patch.corners) {
                corner = corner == cage::kNone ? corner : inPiece(piece.vertices, corner);
            }
        }
        for (uint32_t f = 0; f < piece.faces.size(); ++f) {
            partOfFace_[piece.faces[f]] = static_cast<uint32_t>(parts_.size()) - 1;
            faceInPart_[piece.faces[f]] = f;
        }
    } else {
        std::iota(faceInPart_.begin(), faceInPart_.end(), 0u);
    }
    auto made = cpu::Surface::create(planned->recipe, prepared_->cageOf(part.piece.get()), patches);
    if (!made) {
        return Error{made.error().code, character.name + ": " + made.error().message};
    }
    part.surface = std::move(*made);
    return success();
}

void CpuGroup::addCage() {
    Part& part = parts_.emplace_back();
    part.scheme = SUPPLE_SCHEME_CAGE;
    part.surface = cpu::cageSurface(cage());
    std::iota(faceInPart_.begin(), faceInPart_.end(), 0u);
}

uint64_t CpuGroup::vertexCount(const Part& part, uint32_t rate) {
    const std::array<uint64_t, surface::kDomainCount> patches = domainsOf(*part.surface);
    uint64_t vertices = 0;
    for (uint32_t domain = 0; domain < surface::kDomainCount; ++domain) {
        vertices += patches[domain] * surface::sampleCount(static_cast<surface::Domain>(domain), rate);
    }
    return vertices;
}

uint64_t CpuGroup::indexCount(const Part& part, uint32_t rate) {
    const std::array<uint64_t, surface::kDomainCount> patches = domainsOf(*part.surface);
    uint64_t indices = 0;
    for (uint32_t domain = 0; domain < surface::kDomainCount; ++domain) {
        if (patches[domain] > 0) {
            indices += patches[domain] * surface::gridIndices(static_cast<surface::Domain>(domain), rate).size();
        }
    }
    return indices;
}

void CpuGroup::writeIndices(const Part& part, uint32_t rate, uint32_t* out) {
    uint32_t first = 0;
    GridsByDomain grids(rate);
    for (uint32_t p = 0; p < part.surface->patches().size(); ++p) {
        for (const uint16_t index : grids.of(part.surface->domainOf(p))) {
            *out++ = first + index;
        }
        first += part.surface->samplesOf(p, rate);
    }
}

CpuGroup::Found CpuGroup::find(const SuppleSurfacePoint& point) const {
    Found found;
    if (point.face >= cage().faceCount()) {
        found.place.fault = "there is no such face";
        return found;
    }
    const uint32_t sides = cage().sides(point.face);
    found.place.fault = faultOf(point, sides);
    if (found.place.fault == nullptr) {
        found.part = partOfFace_[point.face];
        cpu::FacePoint inside = clamped(point, sides);
        inside.face = faceInPart_[point.face];
        found.place = parts_[found.part].surface->findPlace(inside);
    }
    return found;
}

CpuPose::CpuPose(std::shared_ptr<const CpuGroup> group)
    : group_(std::move(group)), cage_(group_->cage().vertexCount()) {
    for (const CpuGroup::Part& part : group_->parts()) {
        pieces_.emplace_back(part.piece != nullptr ? part.piece->of.vertices.size() : 0);
        poses_.push_back(part.surface->newPose());
    }
}

Status CpuPose::takeCage(const std::byte* cage, size_t stride) {
    for (size_t v = 0; v < cage_.size(); ++v) {
        glm::vec3 position;
        std::memcpy(&position, cage + v * stride, sizeof(position));
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(position[axis]) <= SUPPLE_MAX_COORDINATE)) {
                return Error{ErrorCode::notFinite,
                             "vertex " + std::to_string(v) + " is not finite or beyond SUPPLE_MAX_COORDINATE"};
            }
        }
    }
    for (size_t v = 0; v < cage_.size(); ++v) {
        std::memcpy(&cage_[v], cage + v * stride, sizeof(cage_[v]));
    }
    return success();
}

Status CpuPose::build(const std::byte* cage, size_t stride, const RunJobs& runJobs) {
    if (Status taken = takeCage(cage, stride); !taken) {
        return taken;
    }
    built_ = false;
    for (size_t p = 0; p < poses_.size(); ++p) {
        const CpuGroup::Part& part = group_->parts()[p];
        for (size_t v = 0; v < pieces_[p].size(); ++v) {
            pieces_[p][v] = cage_[part.piece->of.vertices[v]];
        }
        const std::span<const glm::vec3> own = part.piece != nullptr ? pieces_[p] : cage_;
        if (Status made = poses_[p]->build(own, runJobs); !made) {
            return made;
        }
    }
    built_ = true;
    return success();
}

Status CpuPose::evaluate(std::span<const SuppleSurfacePoint> points, SuppleSurfaceJet* out,
                         const RunJobs& runJobs) const {
    const auto count = static_cast<uint32_t>(points.size());
    std::atomic<uint32_t> firstBad{count};
    Status ran = cpu::inRanges(runJobs, count, kPointsPerJob, [&](uint32_t begin, uint32_t end) {
        for (uint32_t p = begin, some = 0; p < end; p += some) {
            some = std::min(end - p, kPointsAtATime);
            const uint32_t sound = evaluateRange(points.subspan(p, some), out + p);
            uint32_t known = firstBad;
            while (sound < some && p + sound < known && !firstBad.compare_exchange_weak(known, p + sound)) {
            }
        }
    });
    if (!ran) {
        return ran;
    }
    if (firstBad < count) {
        const SuppleSurfacePoint& point = points[firstBad];
        return Error{ErrorCode::range, "points[" + std::to_string(firstBad) + "], face " + std::to_string(point.face) +
                                           ": " + group_->find(point).place.fault};
    }
    return success();
}

uint32_t CpuPose::evaluateRange(std::span<const SuppleSurfacePoint> points, SuppleSurfaceJet* out) const {
    std::array<CpuGroup::Found, kPointsAtATime> found;
    for (uint32_t p = 0; p < points.size(); ++p) {
        found[p] = group_->find(points[p]);
        if (found[p].place.fault != nullptr) {
            return p;
        }
    }
    std::array<cpu::Place, kPointsAtATime> places;
    std::array<uint32_t, kPointsAtATime> numbers;
    std::array<cpu::SurfaceJet, kPointsAtATime> jets, beside;
    for (uint32_t part = 0; part < poses_.size(); ++part) {
        uint32_t count = 0;
        for (uint32_t p = 0; p < points.size(); ++p) {
            if (found[p].part == part) {
                numbers[count] = p;
                places[count++] = found[p].place.place;
            }
        }
        if (count == 0) {
            continue;
        }
        poses_[part]->evaluate(std::span(places).first(count), jets);
        uint32_t heldCount = 0;
        std::array<uint32_t, kPointsAtATime> held;
        for (uint32_t k = 0; k < count; ++k) {
            if (const cpu::FoundPlace& place = found[numbers[k]].place; place.held) {
                held[heldCount] = k;
                places[heldCount++] = place.beside;
            }
        }
        if (heldCount > 0) {
            poses_[part]->evaluate(std::span(places).first(heldCount), beside);
        }
        for (uint32_t h = 0; h < heldCount; ++h) {
            beside[h].position = jets[held[h]].position;
            jets[held[h]] = beside[h];
        }
        for (uint32_t k = 0; k < count; ++k) {
            write(jets[k], out[numbers[k]]);
        }
    }
    return static_cast<uint32_t>(points.size());
}

Status CpuPose::evaluateGrid(uint32_t number, uint32_t rate, float* positions, float* normals,
                             const RunJobs& runJobs) const {
    const cpu::Surface& surface = *group_->parts()[number].surface;
    const auto patchCount = static_cast<uint32_t>(surface.patches().size());
    std::vector<size_t> firstVertices; // of each job
    size_t vertices = 0;
    for (uint32_t p = 0; p < patchCount; ++p) {
        if (p % kPatchesPerJob == 0) {
            firstVertices.push_back(vertices);
        }
        vertices += surface.samplesOf(p, rate);
    }
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && alignof(glm::vec3) == alignof(float));
    const cpu::GridOutput all{{reinterpret_cast<glm::vec3*>(positions), vertices},
                              {reinterpret_cast<glm::vec3*>(normals), normals != nullptr ? vertices : 0}};
    return cpu::inRanges(runJobs, patchCount, kPatchesPerJob, [&](uint32_t begin, uint32_t end) {
        surface.grid(*poses_[number], begin, end, rate, all.from(firstVertices[begin / kPatchesPerJob]));
    });
}

} // namespace supple::runtime
