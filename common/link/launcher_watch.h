#pragma once

/* Ends a launcher that hangs after MPI_Abort.
 *
 * Open MPI 4.1 with PMIx 4.2 can lock itself up when a rank dies while another is within MPI_Finalize: all ranks are
 * dead, and mpirun waits for ever, deaf to SIGTERM.  LauncherWatch leaves a process behind, outside the job's process
 * groups and without its files, which kills this rank's launcher (mpirun or orted of this computer) after five seconds
 * in which that had no living child, and ends with it, after a minute at most.  Nothing happens under other launchers.
 *
 * Called once, before MPI_Abort.  Not collective; Linux alone (/proc). */
void LauncherWatch(void);
