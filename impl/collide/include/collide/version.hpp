/// The version of collide. CMake reads it from here.
#pragma once

#define COLLIDE_VERSION_MAJOR 0
#define COLLIDE_VERSION_MINOR 2
#define COLLIDE_VERSION_PATCH 0

/// The version as one number for comparisons: 10000 * major + 100 * minor + patch.
#define COLLIDE_VERSION (10000 * COLLIDE_VERSION_MAJOR + 100 * COLLIDE_VERSION_MINOR + COLLIDE_VERSION_PATCH)
