// Pictures that are computed, and PNG files of them.
#pragma once

#include "modeller.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace supple::creature {

// A number for each pixel, by its place in [0, 1)^2, v downward.
using Field = std::function<double(double, double)>;
using Painting = std::function<Vec3(double, double)>;

// sRGB-encoded from linear colors, or as they are.
std::vector<std::byte> paintPng(int width, int height, bool srgb, const Painting& painting);
// The normal map of heights that tile: `steep` is height in pixels.
std::vector<std::byte> normalPng(int width, int height, double steep, const Field& heights);

// Smooth noise in [-1, 1] that repeats after so many cells across and down.
double tiledNoise(double x, double y, int across, int down, unsigned seed);
inline double tiledNoise(double x, double y, int period, unsigned seed) {
    return tiledNoise(x, y, period, period, seed);
}
// The nearest of points scattered one a cell, and the next: distances in cells, likewise repeating.
Vec2 tiledCells(double x, double y, int period, unsigned seed);

} // namespace supple::creature
