#include "host/must.h"

#include "base/utf8_path.h"
#include "host/context.h"
#include "host/frames.h"
#include "host/jobs.h"
#include "host/recording.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace supple::host {

void fail(const std::string& what, int exitCode) {
    std::fprintf(stderr, "%s\n", what.c_str());
    std::exit(exitCode);
}

void fail(const Error& error) {
    fail(error.message, error.code == ErrorCode::unsupported ? 3 : 1);
}

void must(VkResult result, const char* what) {
    if (result != VK_SUCCESS)
        fail(vulkanError(result, what));
}

void must(SuppleResult result, const char* what) {
    if (result != SUPPLE_OK)
        fail(std::string(what) + ": " + suppleResultString(result));
}

std::vector<char> mustReadFile(const std::string& path) {
    std::ifstream file(utf8Path(path), std::ios::binary);
    if (!file)
        fail(path + ": cannot be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

std::unique_ptr<Device> mustCreateDevice(DeviceOptions options) {
    const char* value = std::getenv("SUPPLE_VALIDATION");
    options.validation = value != nullptr && *value != 0 && std::string_view(value) != "0";
    return must(Device::create(options));
}

supple::Context mustCreateContext(Device& device, const std::string& record, uint32_t recordingFlags) {
    SuppleContextDesc desc = contextDesc(device);
    desc.framesInFlight = kFramesInFlight;
    desc.log = [](SuppleSeverity severity, SuppleMessage message, const char* text, void*) {
        if (severity != SUPPLE_SEVERITY_INFO)
            std::fprintf(stderr, "supple %d: %s\n", static_cast<int>(message), text);
    };
    desc.runJobs = runJobs;
    supple::Context context;
    must(supple::Context::create(desc, context), "suppleCreateContext");
    if (!record.empty()) {
        std::shared_ptr<Recording> recording = must(Recording::start(context.handle(), record, recordingFlags));
        device.atEnd([recording] {});
    }
    return context;
}

void mustBeSilent(const ValidationLog& validation) {
    if (validation.messageCount() != 0)
        fail("failed: " + std::to_string(validation.messageCount()) + " validation messages");
}

} // namespace supple::host
