// supple_cpu.h.
#include "supple/supple_cpu.h"

#include "runtime/api/descriptions.h"
#include "runtime/api/entry.h"
#include "runtime/api/patches.h"
#include "runtime/cpu_group.h"
#include "runtime/run_jobs.h"

#include <limits>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace supple::api {

/// Whom to tell of errors.
struct CpuLog {
    SuppleLogFunction log = nullptr;
    void* user = nullptr;

    SuppleResult refused(const char* function, const Error& error) const {
        const Verdict verdict = verdictOf(error.code);
        if (log != nullptr) {
            const std::string text = std::string(function) + ": " + error.message;
            log(SUPPLE_SEVERITY_ERROR, verdict.message, text.c_str(), user);
        }
        return verdict.result;
    }
    SuppleResult refused(const char* function, ErrorCode code, const std::string& reason) const {
        return refused(function, Error{code, reason});
    }
    SuppleResult told(const char* function, const Status& status) const {
        return status ? SUPPLE_OK : refused(function, status.error());
    }
};

} // namespace supple::api

namespace {

RunJobs runJobsOf(const SuppleCpuJobs* jobs) {
    return jobs != nullptr ? runtime::runJobsOf(jobs->run, jobs->user) : RunJobs();
}

/// Out of memory is the one thing the standard library throws at us.
template <class Body>
SuppleResult caught(Body&& body) noexcept {
    try {
        return body();
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY;
    }
}

} // namespace

struct SuppleCpuGroup_T {
    std::shared_ptr<const runtime::CpuGroup> group;
    CpuLog log;
};

struct SuppleCpuPose_T {
    runtime::CpuPose pose;
    CpuLog log;
};

namespace {

constexpr const char* kCreateCpuGroup = "suppleCpuCreateGroup";

SuppleResult createCpuGroup(const SuppleCpuGroupDesc& desc, SuppleCpuGroup* out, const CpuLog& log) {
    const auto refuse = [&](ErrorCode code, const std::string& reason) {
        return log.refused(kCreateCpuGroup, code, reason);
    };
    if (out == nullptr || desc.prepared == nullptr) {
        return refuse(ErrorCode::nullPointer, out == nullptr ? "out is null" : "desc.prepared is null");
    }
    if (desc.reserved != 0) {
        return refuse(ErrorCode::range, "reserved is not 0");
    }
    GivenGroup group;
    if (const std::optional<Error> fault = group.takePlanned(desc.group, false)) {
        return refuse(fault->code, fault->message);
    }
    if (group.desc.scheme == SUPPLE_SCHEME_CAGE) {
        return refuse(ErrorCode::argument, "SUPPLE_SCHEME_CAGE has no surface");
    }
    auto made = runtime::CpuGroup::create(desc.prepared->prepared, group.desc);
    if (!made) {
        return log.refused(kCreateCpuGroup, made.error());
    }
    *out = new SuppleCpuGroup_T{std::move(*made), log};
    return SUPPLE_OK;
}

/// Fills an out struct of whatever version.
template <class T>
SuppleResult fillCpuInfo(const CpuLog& log, const char* function, const T& info, T* out) {
    if (out == nullptr) {
        return log.refused(function, ErrorCode::nullPointer, "out is null");
    }
    if (!runtime::isPossibleSize<T>(out->structSize)) {
        return log.refused(function, ErrorCode::structSize, faultOfSize<T>("out", out->structSize));
    }
    runtime::writeSized(info, *out);
    return SUPPLE_OK;
}

/// Why there is no such surface, or success.
Status checkSurface(const runtime::CpuGroup& group, uint32_t surface) {
    return surface < group.parts().size()
               ? success()
               : Status(Error{ErrorCode::range,
                              "surface " + std::to_string(surface) + " of " + std::to_string(group.parts().size())});
}

/// The room that a host gives must be that of the grid.
Status checkRoom(const char* what, uint64_t needed, uint32_t given) {
    return needed == given ? success()
                           : Status(Error{ErrorCode::range, "room for " + std::to_string(given) + " " + what +
                                                                " for a grid of " + std::to_string(needed)});
}

/// Why a surface has no grid of a rate, or success.
Status checkGrid(const runtime::CpuGroup& group, uint32_t surface, uint32_t rate) {
    if (Status exists = checkSurface(group, surface); !exists) {
        return exists;
    }
    if (rate == 0 || rate > SUPPLE_MAX_RATE) {
        return Error{ErrorCode::range,
                     "rate " + std::to_string(rate) + " leaves 1.." + std::to_string(SUPPLE_MAX_RATE)};
    }
    return success();
}

/// Indices are 32 bits.
Status checkIndices(uint64_t indices) {
    return indices <= std::numeric_limits<uint32_t>::max()
               ? success()
               : Status(Error{ErrorCode::limit, std::to_string(indices) + " indices are more than 32 bits number"});
}

} // namespace

SuppleResult suppleCpuCreateGroup(const SuppleCpuGroupDesc* given, SuppleCpuGroup* out) {
    if (out != nullptr) {
        *out = nullptr;
    }
    if (given == nullptr || !runtime::isPossibleSize<SuppleCpuGroupDesc>(given->structSize)) {
        return SUPPLE_ERROR_ARGUMENT; // a struct of no version has no log function to tell
    }
    return caught([&] {
        SuppleCpuGroupDesc desc{};
        const bool read = runtime::readSized(*given, desc);
        const CpuLog log{given->log, given->logUser};
        return read ? createCpuGroup(desc, out, log)
                    : log.refused(kCreateCpuGroup, ErrorCode::structSize,
                                  faultOfSize<SuppleCpuGroupDesc>("desc", given->structSize));
    });
}

void suppleCpuDestroyGroup(SuppleCpuGroup group) {
    delete group;
}

SuppleResult suppleCpuGetGroupInfo(SuppleCpuGroup group, SuppleCpuGroupInfo* out) {
    if (group == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        SuppleCpuGroupInfo info{};
        info.cageVertexCount = group->group->cage().vertexCount();
        info.faceCount = group->group->cage().faceCount();
        info.surfaceCount = static_cast<uint32_t>(group->group->parts().size());
        return fillCpuInfo(group->log, "suppleCpuGetGroupInfo", info, out);
    });
}

SuppleResult suppleCpuCreatePose(SuppleCpuGroup group, SuppleCpuPose* out) {
    if (out != nullptr) {
        *out = nullptr;
    }
    if (group == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        if (out == nullptr) {
            return group->log.refused("suppleCpuCreatePose", ErrorCode::nullPointer, "out is null");
        }
        *out = new SuppleCpuPose_T{runtime::CpuPose(group->group), group->log};
        return SUPPLE_OK;
    });
}

void suppleCpuDestroyPose(SuppleCpuPose pose) {
    delete pose;
}

SuppleResult suppleCpuBuildPose(SuppleCpuPose pose, const float* cage, size_t stride, uint32_t vertexCount,
                                const SuppleCpuJobs* jobs) {
    constexpr const char* kHere = "suppleCpuBuildPose";
    if (pose == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        if (cage == nullptr) {
            return pose->log.refused(kHere, ErrorCode::nullPointer, "cage is null");
        }
        if (stride < 3 * sizeof(float) || stride % sizeof(float) != 0) {
            return pose->log.refused(kHere, ErrorCode::range,
                                     "a stride of " + std::to_string(stride) +
                                         " bytes is not 12 or more, or no multiple of 4");
        }
        if (const uint32_t own = pose->pose.group().cage().vertexCount(); vertexCount != own) {
            return pose->log.refused(kHere, ErrorCode::range,
                                     std::to_string(vertexCount) + " vertices for a cage of " + std::to_string(own));
        }
        return pose->log.told(kHere,
                              pose->pose.build(reinterpret_cast<const std::byte*>(cage), stride, runJobsOf(jobs)));
    });
}

SuppleResult suppleCpuEvaluatePoints(SuppleCpuPose pose, const SuppleSurfacePoint* points, uint32_t count,
                                     SuppleSurfaceJet* out, const SuppleCpuJobs* jobs) {
    constexpr const char* kHere = "suppleCpuEvaluatePoints";
    if (pose == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        if (!pose->pose.isBuilt()) {
            return pose->log.refused(kHere, ErrorCode::order, "the pose is not built");
        }
        if (count > 0 && (points == nullptr || out == nullptr)) {
            return pose->log.refused(kHere, ErrorCode::nullPointer, "points or out is null");
        }
        return pose->log.told(kHere, pose->pose.evaluate({points, count}, out, runJobsOf(jobs)));
    });
}

SuppleResult suppleCpuGetPatches(SuppleCpuGroup group, uint32_t surface, SupplePatchInfo* out, uint32_t* count) {
    constexpr const char* kHere = "suppleCpuGetPatches";
    if (group == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        if (count == nullptr) {
            return group->log.refused(kHere, ErrorCode::nullPointer, "count is null");
        }
        if (const Status exists = checkSurface(*group->group, surface); !exists) {
            return group->log.refused(kHere, exists.error());
        }
        return fillPatches(group->group->parts()[surface].patches, out, count);
    });
}

SuppleResult suppleCpuGetGridInfo(SuppleCpuGroup group, uint32_t surface, uint32_t rate, SuppleCpuGridInfo* out) {
    constexpr const char* kHere = "suppleCpuGetGridInfo";
    if (group == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        if (const Status fits = checkGrid(*group->group, surface, rate); !fits) {
            return group->log.refused(kHere, fits.error());
        }
        const runtime::CpuGroup::Part& part = group->group->parts()[surface];
        const uint64_t indices = runtime::CpuGroup::indexCount(part, rate); // more than there are vertices
        if (const Status fits = checkIndices(indices); !fits) {
            return group->log.refused(kHere, fits.error());
        }
        SuppleCpuGridInfo info{};
        info.scheme = part.scheme;
        info.patchCount = static_cast<uint32_t>(part.surface->patches().size());
        info.vertexCount = static_cast<uint32_t>(runtime::CpuGroup::vertexCount(part, rate));
        info.indexCount = static_cast<uint32_t>(indices);
        return fillCpuInfo(group->log, kHere, info, out);
    });
}

SuppleResult suppleCpuGetGridIndices(SuppleCpuGroup group, uint32_t surface, uint32_t rate, uint32_t* out,
                                     uint32_t count) {
    constexpr const char* kHere = "suppleCpuGetGridIndices";
    if (group == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        if (out == nullptr) {
            return group->log.refused(kHere, ErrorCode::nullPointer, "out is null");
        }
        if (const Status fits = checkGrid(*group->group, surface, rate); !fits) {
            return group->log.refused(kHere, fits.error());
        }
        const runtime::CpuGroup::Part& part = group->group->parts()[surface];
        if (const Status fits = checkRoom("indices", runtime::CpuGroup::indexCount(part, rate), count); !fits) {
            return group->log.refused(kHere, fits.error());
        }
        runtime::CpuGroup::writeIndices(part, rate, out);
        return SUPPLE_OK;
    });
}

SuppleResult suppleCpuEvaluateGrid(SuppleCpuPose pose, uint32_t surface, uint32_t rate, float* positions,
                                   float* normals, uint32_t vertexCount, const SuppleCpuJobs* jobs) {
    constexpr const char* kHere = "suppleCpuEvaluateGrid";
    if (pose == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    return caught([&] {
        if (!pose->pose.isBuilt()) {
            return pose->log.refused(kHere, ErrorCode::order, "the pose is not built");
        }
        if (positions == nullptr) {
            return pose->log.refused(kHere, ErrorCode::nullPointer, "positions is null");
        }
        if (const Status fits = checkGrid(pose->pose.group(), surface, rate); !fits) {
            return pose->log.refused(kHere, fits.error());
        }
        const runtime::CpuGroup::Part& part = pose->pose.group().parts()[surface];
        if (const Status fits = checkRoom("vertices", runtime::CpuGroup::vertexCount(part, rate), vertexCount); !fits) {
            return pose->log.refused(kHere, fits.error());
        }
        return pose->log.told(kHere, pose->pose.evaluateGrid(surface, rate, positions, normals, runJobsOf(jobs)));
    });
}
