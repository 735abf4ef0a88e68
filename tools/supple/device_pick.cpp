#include "tools/supple/device_pick.h"

namespace supple::tools {

namespace {

constexpr SuppleSyncScope kAnything{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                    VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};

Status begin(host::Context& context) {
    const uint64_t frame = context.nextFrame();
    return context.check(suppleBeginFrame(context.handle(), frame, frame - 1), "suppleBeginFrame");
}

Status ask(Session& session, SuppleGroup group, SuppleQueryPool pool, const SuppleQueryDesc& asked) {
    host::Context& context = *session.context;
    if (Status begun = begin(context); !begun) {
        return begun;
    }
    SuppleRecordDesc desc{};
    desc.structSize = sizeof desc;
    desc.groups = &group;
    desc.groupCount = 1;
    desc.before = desc.after = kAnything;
    Status recorded = success();
    const Status submitted = session.device->submitAndWait([&](VkCommandBuffer commands) {
        recorded = context.check(suppleRecord(context.handle(), commands, &desc), "suppleRecord");
        recorded = recorded ? context.check(suppleRecordQueries(context.handle(), commands, pool, &asked),
                                            "suppleRecordQueries")
                            : recorded;
    });
    if (!recorded || !submitted) {
        return recorded ? submitted : recorded;
    }
    return begin(context); // tells that the frame is complete
}

} // namespace

Result<std::optional<SuppleHit>> pickOnDevice(Session& session, SuppleGroup group, SuppleQueryDesc asked) {
    host::Context& context = *session.context;
    SuppleQueryPoolDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = SUPPLE_QUERY_POOL_NEAREST;
    desc.groups = &group;
    desc.groupCount = 1;
    desc.rayCount = 1;
    SuppleQueryPool pool{};
    if (const Status made =
            context.check(suppleCreateQueryPool(context.handle(), &desc, &pool), "suppleCreateQueryPool");
        !made) {
        return made.error();
    }
    asked.structSize = sizeof asked;
    asked.flags = SUPPLE_QUERY_READ_BACK;
    asked.rayCount = 1;
    asked.before = asked.after = kAnything;
    Status status = ask(session, group, pool, asked);
    SuppleHit hit{};
    uint32_t count = 1;
    status = status ? context.check(suppleReadHits(context.handle(), pool, &hit, &count, nullptr), "suppleReadHits")
                    : status;
    suppleDestroyQueryPool(context.handle(), pool);
    if (!status) {
        return status.error();
    }
    return hit.group == SUPPLE_NO_HIT ? std::optional<SuppleHit>() : std::optional(hit);
}

} // namespace supple::tools
