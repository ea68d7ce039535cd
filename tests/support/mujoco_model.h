#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <string>

namespace hoplab::testing {

using MujocoModel = std::unique_ptr<mjModel, void (*)(mjModel*)>;
using MujocoData = std::unique_ptr<mjData, void (*)(mjData*)>;

/// The model of a file, or of a text. Throws std::runtime_error with what MuJoCo says against it.
MujocoModel LoadMujoco(const std::filesystem::path& file);
MujocoModel CompileMujoco(const std::string& text);

/// The state of `model`, all at its null.
MujocoData NewData(const mjModel& model);

}  // namespace hoplab::testing
