// The options that samples which draw have in common, read by CLI11.
#pragma once

#include <vulkan/vulkan.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace supple::host {

struct PictureOptions {
    std::string screenshot;
    VkExtent2D size{1280, 720};
    uint32_t rate = 0;
    uint64_t frames = 0;
    std::string record; ///< a file for a recording; empty: none
};

inline void addPictureOptions(CLI::App& app, PictureOptions& options) {
    app.add_option("--frames", options.frames, "a sixtieth of a second each")->capture_default_str();
    app.add_option("--screenshot", options.screenshot, "save the last frame as PNG")->type_name("FILE");
    app.add_option("--record", options.record, "write a recording, for supple replay")->type_name("FILE");
    app.add_option("--rate", options.rate, "segments along an edge")->check(CLI::Range(1u, 64u))->capture_default_str();
    const auto readSize = [&options](const std::string& text) {
        char end = '\0';
        const int read = std::sscanf(text.c_str(), "%ux%u%c", &options.size.width, &options.size.height, &end);
        if (read != 2 || options.size.width == 0 || options.size.height == 0)
            throw CLI::ValidationError("--size", "is not WIDTHxHEIGHT: " + text);
    };
    app.add_option_function<std::string>("--size", readSize, "1280x720")->type_name("WxH");
}

/// Ends the program after --help or on wrong usage.
inline void parse(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::exit(app.exit(error) == 0 ? 0 : 2);
    }
}

} // namespace supple::host
