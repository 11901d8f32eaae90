// Finds this process's rank and the number of processes before MPI is initialised.
#pragma once

namespace octoblisk::demos {

struct Launch {
  int rank = 0;
  int count = 1;
};

/// Reads the environment that mpirun (Open MPI, MPICH) or srun (with PMI or PMIx) sets; a single process by
/// default.
Launch launchedAs();

}  // namespace octoblisk::demos
