#pragma once
// Handing over to dmoscope-mpi when mpirun started dmoscope, for each of its processes would do the whole job.

namespace dmoscope::app {

/// Becomes dmoscope-mpi, which lies beside this program, and does not return, if a launcher of MPI jobs started this process. If
/// dmoscope-mpi is missing, throws UsageError in the first process, and ends the others.
void hand_over_to_mpi(char** argv);

}  // namespace dmoscope::app
