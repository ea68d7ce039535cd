#include "app/runs/mpi_library.h"

#include <dlfcn.h>

#include <string>

#include "base/input_error.h"

namespace hoplab {
namespace {

[[noreturn]] void Refuse(const std::string& rule) {
  throw InputError({HOPLAB_MPI_LIBRARY, "", rule,
                    "A launcher of MPI started this process, so it needs this library: on Debian "
                    "the package libopenmpi3. Without the launcher one process does all the work"});
}

// MPI loads parts of itself, which look for its symbols among those of the whole process.
void* Open() {
  void* library = dlopen(HOPLAB_MPI_LIBRARY, RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) Refuse("cannot be opened");
  return library;
}

void* Symbol(void* library, const char* name) {
  void* symbol = dlsym(library, name);
  if (symbol == nullptr) Refuse(std::string("has no ") + name);
  return symbol;
}

template <class Function>
void Find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(Symbol(library, name));
}

// OpenMPI's handles are addresses of its variables; those of others are numbers in its header.
#ifdef OPEN_MPI
#define HOPLAB_MPI_HANDLE(library, symbol, value) \
  static_cast<decltype(value)>(Symbol(library, symbol))
#else
#define HOPLAB_MPI_HANDLE(library, symbol, value) value
#endif

MpiLibrary Load() {
  void* library = Open();
  MpiLibrary mpi{};
  Find(library, "MPI_Abort", mpi.Abort);
  Find(library, "MPI_Bcast", mpi.Bcast);
  Find(library, "MPI_Comm_rank", mpi.Comm_rank);
  Find(library, "MPI_Comm_size", mpi.Comm_size);
  Find(library, "MPI_Finalize", mpi.Finalize);
  Find(library, "MPI_Get_count", mpi.Get_count);
  Find(library, "MPI_Improbe", mpi.Improbe);
  Find(library, "MPI_Imrecv", mpi.Imrecv);
  Find(library, "MPI_Init", mpi.Init);
  Find(library, "MPI_Isend", mpi.Isend);
  Find(library, "MPI_Probe", mpi.Probe);
  Find(library, "MPI_Recv", mpi.Recv);
  Find(library, "MPI_Send", mpi.Send);
  Find(library, "MPI_Test", mpi.Test);
  mpi.world = HOPLAB_MPI_HANDLE(library, "ompi_mpi_comm_world", MPI_COMM_WORLD);
  mpi.chars = HOPLAB_MPI_HANDLE(library, "ompi_mpi_char", MPI_CHAR);
  mpi.ints = HOPLAB_MPI_HANDLE(library, "ompi_mpi_int", MPI_INT);
  mpi.unsigned_long_longs =
      HOPLAB_MPI_HANDLE(library, "ompi_mpi_unsigned_long_long", MPI_UNSIGNED_LONG_LONG);
  mpi.no_message = HOPLAB_MPI_HANDLE(library, "ompi_message_null", MPI_MESSAGE_NULL);
  mpi.no_request = HOPLAB_MPI_HANDLE(library, "ompi_request_null", MPI_REQUEST_NULL);
  return mpi;
}

}  // namespace

const MpiLibrary& Mpi() {
  static const MpiLibrary mpi = Load();
  return mpi;
}

}  // namespace hoplab
