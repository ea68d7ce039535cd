#include "tests/support/mujoco_model.h"

#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace hoplab::testing {

MujocoModel LoadMujoco(const std::filesystem::path& file) {
  char message[1000] = "";
  MujocoModel model(mj_loadXML(file.c_str(), nullptr, message, sizeof message), mj_deleteModel);
  if (!model) throw std::runtime_error(std::string("MuJoCo does not take the model: ") + message);
  return model;
}

MujocoModel CompileMujoco(const std::string& text) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("hoplab-mujoco-" + std::to_string(getpid()) + ".xml");
  std::ofstream(file) << text;
  // Removed whatever MuJoCo says of it.
  const auto remove = [](const std::filesystem::path* of) {
    std::error_code ignored;
    std::filesystem::remove(*of, ignored);
  };
  const std::unique_ptr<const std::filesystem::path, decltype(remove)> written(&file, remove);
  return LoadMujoco(file);
}

MujocoData NewData(const mjModel& model) { return {mj_makeData(&model), mj_deleteData}; }

}  // namespace hoplab::testing
