// As which of how many processes this one was started, told before MPI is asked.
#pragma once

namespace octoblisk::demos {

struct Launch {
  int rank = 0;
  int count = 1;
};

/// What mpirun (Open MPI, MPICH) or srun (with PMI or PMIx) left in the environment; one alone by default.
Launch launchedAs();

}  // namespace octoblisk::demos
