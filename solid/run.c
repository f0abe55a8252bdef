#include "solid/run.h"
#include "solid/solid_case.h"

PetscErrorCode SolidRunCreate(const Program *program, SolidRun *m)
{
  const char *resume = CoracleResumePath(program->client);
  PetscFunctionBeginUser;
  *m = (SolidRun){.program = program};
  PetscCall(SolidFromCase(program->c, program->comm, &m->solid));
  if (resume) {
    PetscCall(CheckpointOpen(program->comm, resume, "solid", &m->from));
    PetscCall(SolidLoad(m->solid, m->from));
  }
  if (SolidCasePressureLoad(program->c)) PetscCall(CoracleSetPressureLoad(program->client));
  PetscCall(ExchangeCreate(program->client, m->solid, &m->exchange));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidRunOpenOutput(SolidRun *m)
{
  PetscFunctionBeginUser;
  PetscCall(WriterCreate(m->program->c, m->program->comm, m->solid, m->from, &m->writer));
  PetscCall(CheckpointClose(&m->from));
  m->exchange.waited = 0.0; /* the output's seconds begin here, too */
  PetscFunctionReturn(0);
}

PetscErrorCode SolidRunSave(const SolidRun *m)
{
  const char *folder = CoracleCheckpointPath(m->program->client);
  Checkpoint to;
  PetscFunctionBeginUser;
  if (!folder) PetscFunctionReturn(0);
  PetscCall(CheckpointCreate(m->program->comm, folder, "solid", &to));
  PetscCall(SolidSave(m->solid, to));
  PetscCall(WriterSave(m->writer, m->exchange.waited, to));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidReport(Solid solid, SolidTell tell, void *context)
{
  static const char *const PHASES[] = {"seconds_elements", "seconds_contact", "seconds_exchange",
                                       "seconds_limit",    "seconds_joints",  "seconds_response"};
  const SolidStats *stats = SolidGetStats(solid);
  SolidView v;
  PetscFunctionBeginUser;
  SolidGetView(solid, &v);
  PetscCall(tell(context, "elements", v.nelements, 1));
  PetscCall(tell(context, "bodies", v.nbodies, 0));
  PetscCall(tell(context, "substeps", (double)stats->total, 0));
  PetscCall(tell(context, "contact_searches", stats->searches, 0));
  PetscCall(tell(context, "response_iterations", (double)stats->response_iterations, 0));
  PetscCall(tell(context, "rebalanced", stats->rebalanced, 0));
  for (int k = 0; k < 6; k++) PetscCall(tell(context, PHASES[k], stats->seconds[k], 0));
  PetscFunctionReturn(0);
}

static int Tell(void *client, const char *key, double value, int sum)
{
  return CoracleReport(client, key, value, sum);
}

PetscErrorCode SolidRunDestroy(SolidRun *m)
{
  PetscFunctionBeginUser;
  PetscCall(SolidReport(m->solid, Tell, m->program->client));
  PetscCall(WriterDestroy(&m->writer));
  PetscCall(ExchangeDestroy(&m->exchange));
  PetscCall(SolidDestroy(&m->solid));
  PetscFunctionReturn(0);
}
