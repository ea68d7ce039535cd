#pragma once

#include <mpi.h>

namespace hoplab {

/// What a job calls of MPI, by the names without their prefix. The program is not linked to MPI:
/// its library brings seven others along, which every start would wait for.
struct MpiLibrary {
  decltype(&::MPI_Abort) Abort;
  decltype(&::MPI_Bcast) Bcast;
  decltype(&::MPI_Comm_rank) Comm_rank;
  decltype(&::MPI_Comm_size) Comm_size;
  decltype(&::MPI_Finalize) Finalize;
  decltype(&::MPI_Get_count) Get_count;
  decltype(&::MPI_Improbe) Improbe;
  decltype(&::MPI_Imrecv) Imrecv;
  decltype(&::MPI_Init) Init;
  decltype(&::MPI_Isend) Isend;
  decltype(&::MPI_Probe) Probe;
  decltype(&::MPI_Recv) Recv;
  decltype(&::MPI_Send) Send;
  decltype(&::MPI_Test) Test;

  MPI_Comm world;
  MPI_Datatype chars, ints, unsigned_long_longs;
  MPI_Message no_message;
  MPI_Request no_request;
};

/// Opens the library at the first call; InputError where the system has none.
const MpiLibrary& Mpi();

}  // namespace hoplab
