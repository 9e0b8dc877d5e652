#pragma once
// dmoscope started by mpirun is many processes, each of which would do the whole job.

namespace dmoscope::app {

/// Where a launcher of MPI jobs started this process: becomes dmoscope-mpi, which lies beside it, and does not return. Where that is
/// not there, throws UsageError in the first process, and ends the others.
void hand_over_to_mpi(char** argv);

}  // namespace dmoscope::app
