// Descriptions of assets and groups, checked and taken in. What they point to stays the caller's.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "runtime/prepared.h"
#include "supple/supple.h"

#include <memory>
#include <optional>

/// What a SupplePrepared points to.
struct SupplePrepared_T {
    std::shared_ptr<const supple::runtime::Prepared> prepared;
};

namespace supple::api {

/// Checks a description, which messages call `name`, and takes in whatever version it has. Null if it is sound.
[[nodiscard]] std::optional<Error> takeAsset(const char* name, const SuppleAssetDesc* given, SuppleAssetDesc& out);
/// Whether the description has a cooked file (runtime/cooked/file.h).
[[nodiscard]] bool isCooked(const SuppleAssetDesc& desc);
/// What a cooked file has. Refuses options that are about reading other files.
[[nodiscard]] Result<std::shared_ptr<runtime::Prepared>> readCookedAsset(const SuppleAssetDesc& desc);
/// Another file in memory or arrays, as a character. `function` begins the messages about structs within the
/// description.
[[nodiscard]] Result<cage::Character> readAsset(const char* function, const SuppleAssetDesc& desc);

/// A group's description, with copies of the options that it points to.
struct GivenGroup {
    SuppleGroupDesc desc{};
    SupplePrepOptions prep{};
    SuppleBlendOptions blend{};
    SuppleFragmentsOptions fragments{};

    GivenGroup() = default;
    GivenGroup(const GivenGroup&) = delete;
    GivenGroup& operator=(const GivenGroup&) = delete;

    /// Null if it is sound.
    [[nodiscard]] std::optional<Error> take(const SuppleGroupDesc* given);
    /// The same of a group that is to come: asset, capacity, view and instancesOf do not matter.
    [[nodiscard]] std::optional<Error> takePlanned(const SuppleGroupDesc* given, bool inView);

private:
    [[nodiscard]] std::optional<Error> check();
    [[nodiscard]] std::optional<Error> takeOptions();
};

} // namespace supple::api
