# MuJoCo (libmujoco-dev), another engine to test against and to be timed beside. Where it is found
# there is a target hoplab_mujoco.
find_library(HOPLAB_MUJOCO mujoco)
find_path(HOPLAB_MUJOCO_INCLUDE mujoco/mujoco.h)
if(HOPLAB_MUJOCO AND HOPLAB_MUJOCO_INCLUDE)
  add_library(hoplab_mujoco INTERFACE)
  target_link_libraries(hoplab_mujoco INTERFACE ${HOPLAB_MUJOCO})
  target_include_directories(hoplab_mujoco SYSTEM INTERFACE ${HOPLAB_MUJOCO_INCLUDE})
else()
  message(STATUS "MuJoCo (libmujoco-dev) not found: tests and benchmarks that use it are left out")
endif()
