// supple_prepare.h.
#include "runtime/prepare.h"
#include "runtime/api/descriptions.h"
#include "runtime/api/entry.h"
#include "runtime/cooked/file.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

constexpr const char* kPrepare = "supplePrepare";
constexpr float kMostClipError = 0.1f;

Error here(const Error& error) {
    return {error.code, std::string(kPrepare) + ": " + error.message};
}

Error here(ErrorCode code, const std::string& reason) {
    return here(Error{code, reason});
}

Result<std::shared_ptr<runtime::Prepared>> readCharacter(const SupplePrepareDesc& desc) {
    SuppleAssetDesc asset{};
    if (const std::optional<Error> fault = takeAsset("desc.asset", desc.asset, asset)) {
        return here(*fault);
    }
    if (asset.prepared != nullptr) {
        return here(ErrorCode::argument, "the asset is prepared already");
    }
    if (asset.clipPoolBytes != 0) {
        return here(ErrorCode::argument,
                    "asset.clipPoolBytes is for suppleCreateAsset: what is prepared has all clips");
    }
    if (isCooked(asset)) {
        return readCookedAsset(asset);
    }
    Result<cage::Character> character = readAsset(kPrepare, asset);
    if (!character) {
        return character.error();
    }
    return runtime::Prepared::of(std::move(*character));
}

/// Calls `work` for each planned group until it fails. `function` begins the messages.
template <class Work>
Status forPlanned(const char* function, const SupplePlannedGroup* groups, uint32_t groupCount, Work&& work) {
    for (uint32_t g = 0; g < groupCount; ++g) {
        const SupplePlannedGroup& planned = groups[g];
        const auto refuse = [&](ErrorCode code, const std::string& reason) {
            return Error{code, std::string(function) + ": groups[" + std::to_string(g) + "]: " + reason};
        };
        GivenGroup group;
        if (const std::optional<Error> fault = group.takePlanned(planned.desc, planned.inView != 0)) {
            return refuse(fault->code, fault->message);
        }
        if (planned.inView == 0 && planned.viewFlags != 0) {
            return refuse(ErrorCode::argument, "viewFlags without a view");
        }
        const std::optional<uint32_t> flags =
            planned.inView != 0 ? std::optional<uint32_t>(planned.viewFlags) : std::nullopt;
        if (const Status status = work({group.desc, flags}); !status) {
            return refuse(status.error().code, status.error().message);
        }
    }
    return success();
}

Result<std::shared_ptr<const runtime::Prepared>> prepare(const SupplePrepareDesc& desc) {
    if (!within(desc.mapping, SUPPLE_MAPPING_WIDE)) {
        return here(ErrorCode::range, "no such mapping");
    }
    if (desc.groupCount > 0 && desc.groups == nullptr) {
        return here(ErrorCode::nullPointer, "groups is null");
    }
    if (!(desc.clipError >= 0.0f && desc.clipError <= kMostClipError)) {
        return here(ErrorCode::range, "clipError leaves 0..0.1");
    }
    if (!(desc.coarseClipError >= 0.0f && desc.coarseClipError <= kMostClipError)) {
        return here(ErrorCode::range, "coarseClipError leaves 0..0.1");
    }
    if (desc.coarseClipError > 0.0f && !(desc.clipError > 0.0f && desc.coarseClipError > desc.clipError)) {
        return here(ErrorCode::argument, "coarseClipError is not more than clipError, or clips are not packed");
    }
    const Result<std::shared_ptr<runtime::Prepared>> prepared = readCharacter(desc);
    if (!prepared) {
        return prepared.error();
    }
    if (desc.clipError > 0.0f) {
        (*prepared)->packClips(static_cast<double>(desc.clipError), static_cast<double>(desc.coarseClipError));
    }
    const Status status = forPlanned(kPrepare, desc.groups, desc.groupCount, [&](const runtime::PlannedGroup& group) {
        return runtime::prepareFor(**prepared, group, desc.mapping != SUPPLE_MAPPING_NARROW);
    });
    if (!status) {
        return status.error();
    }
    return std::shared_ptr<const runtime::Prepared>(*prepared);
}

} // namespace

SuppleResult supplePrepare(const SupplePrepareDesc* given, SupplePrepared* out) {
    if (out != nullptr) {
        *out = nullptr;
    }
    if (given == nullptr || !runtime::isPossibleSize<SupplePrepareDesc>(given->structSize)) {
        return SUPPLE_ERROR_ARGUMENT; // a struct of no version has no log function to tell
    }
    try {
        SupplePrepareDesc desc{};
        const bool read = runtime::readSized(*given, desc);
        const auto tell = [&](SuppleSeverity severity, SuppleMessage message, const std::string& text) {
            if (given->log != nullptr) {
                given->log(severity, message, text.c_str(), given->logUser);
            }
        };
        const auto refused = [&](const Error& error) {
            const Verdict verdict = verdictOf(error.code);
            tell(SUPPLE_SEVERITY_ERROR, verdict.message, error.message);
            return verdict.result;
        };
        if (!read) {
            return refused(here(ErrorCode::structSize, faultOfSize<SupplePrepareDesc>("desc", given->structSize)));
        }
        if (out == nullptr) {
            return refused(here(ErrorCode::nullPointer, "out is null"));
        }
        Result<std::shared_ptr<const runtime::Prepared>> prepared = prepare(desc);
        if (!prepared) {
            return refused(prepared.error());
        }
        const cage::Character& character = (*prepared)->character;
        for (const std::string& warning : character.warnings) {
            tell(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_ASSET_WARNING, character.name + ": " + warning);
        }
        *out = new SupplePrepared_T{std::move(*prepared)};
        return SUPPLE_OK;
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY; // nothing else is thrown at us
    }
}

SuppleResult suppleMakePipelines(SuppleContext handle, SupplePrepared prepared, const SupplePlannedGroup* groups,
                                 uint32_t groupCount) {
    constexpr const char* kHere = "suppleMakePipelines";
    return onDevice(handle, kHere, [&](Context& context) {
        if (prepared == nullptr || (groups == nullptr && groupCount > 0)) {
            return refuse(context, ErrorCode::nullPointer, kHere, "prepared or groups is null");
        }
        return reportStatus(context, forPlanned(kHere, groups, groupCount, [&](const runtime::PlannedGroup& group) {
                                return context.makePipelines(*prepared->prepared, group);
                            }));
    });
}

SuppleResult suppleSavePrepared(SupplePrepared prepared, const char* madeBy, void* out, size_t* byteCount) {
    if (prepared == nullptr || byteCount == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    try {
        const std::string command = madeBy != nullptr ? madeBy : "";
        const size_t room = *byteCount;
        *byteCount = runtime::cookedBytes(*prepared->prepared, command);
        if (out == nullptr) {
            return SUPPLE_OK;
        }
        if (room < *byteCount) {
            return SUPPLE_ERROR_ARGUMENT;
        }
        runtime::writeCooked(*prepared->prepared, command, {static_cast<std::byte*>(out), *byteCount});
        return SUPPLE_OK;
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY;
    }
}

void suppleDestroyPrepared(SupplePrepared prepared) {
    delete prepared;
}
