/* Fields into messages and out of them. */
#include "common/link/fields.h"
#include <string.h>

static size_t Bytes(const Field *field, const int extent[NEXTENTS])
{
  static const size_t TYPE[] = {sizeof(double), sizeof(int), sizeof(int), sizeof(long long)};
  return TYPE[field->type] * (size_t)FieldSize(field, extent);
}

static bool Travels(const Field *field, int flags)
{
  return field->only <= 0 || (flags & field->only);
}

/* --- packing -------------------------------------------------------------------------------------------- */

/* Checks the rows values[n][size], where they are about to travel; carries: NULL, or whose they are. */
static void Check(Participant *p, const FieldGroup *group, const Field *field, const char carries[], size_t n,
                  int size, const double values[])
{
  static const char *const EXPECTED[] = {"", "it must not be negative", "it must be positive"};
  MessageCheckFinite(p, field->name, group->entity, carries, n, size, values);
  if (field->range == FIELD_ANY) return;
  for (size_t i = 0; i < n * (size_t)size; i++)
    if (values[i] < 0.0 || (field->range == FIELD_POSITIVE && values[i] == 0.0))
      ParticipantFail(p, "%s is %g %s at %s %zu in step %d: %s", field->name, values[i], field->unit,
                      group->entity, i / (size_t)size, p->step, EXPECTED[field->range]);
}

static void PackArray(Participant *p, Message *m, const FieldGroup *group, const Field *field, size_t n,
                      size_t bytes, const void *structure)
{
  const void *array;
  memcpy(&array, (const char *)structure + field->offset, sizeof array);
  if (!array && n)
    ParticipantFail(p, "the %s of %zu %ss is missing in step %d: the pointer is NULL", field->name, n,
                    group->entity, p->step);
  MessageAdd(m, array, n * bytes);
}

/* A value of so many bytes, often few. */
static void CopyValue(char *to, const char *from, size_t bytes)
{
  size_t k = 0;
  for (; k + sizeof(double) <= bytes; k += sizeof(double)) memcpy(to + k, from + k, sizeof(double));
  for (; k < bytes; k++) to[k] = from[k];
}

static void PackEntries(Message *m, const FieldGroup *group, const Field *field, size_t n, size_t bytes,
                        const char *entries)
{
  MessageAdd(m, NULL, n * bytes);
  char *to = m->buffer.data + m->last;
  for (size_t i = 0; i < n; i++) CopyValue(to + i * bytes, entries + i * group->entry + field->offset, bytes);
}

static bool IsZero(const char *value, size_t bytes)
{
  for (size_t k = 0; k < bytes; k += sizeof(double)) {
    double v;
    memcpy(&v, value + k, sizeof v);
    if (v != 0.0) return false;
  }
  return true;
}

/* Two blocks: which entries carry the field, and the values of these. */
static void PackSparse(Participant *p, Message *m, const FieldGroup *group, const Field *field, size_t n,
                       size_t bytes, const char *entries)
{
  size_t count = 0;
  MessageAdd(m, NULL, n);
  const size_t at = m->last;
  for (size_t i = 0; i < n; i++)
    count += m->buffer.data[at + i] = !IsZero(entries + i * group->entry + field->offset, bytes);
  MessageAdd(m, NULL, count * bytes);
  const char *carries = m->buffer.data + at;
  char *to = m->buffer.data + m->last;
  for (size_t i = 0; i < n; i++) {
    if (!carries[i]) continue;
    CopyValue(to, entries + i * group->entry + field->offset, bytes);
    to += bytes;
  }
  Check(p, group, field, carries, count, (int)(bytes / sizeof(double)),
        (const double *)(const void *)(m->buffer.data + m->last));
}

void FieldsPack(Participant *p, Message *m, const FieldGroup *group, size_t n, const void *data)
{
  int extent[NEXTENTS];
  FieldsExtents(p->dim, extent);
  MessageHeaderOf(m)->dim = p->dim;
  for (int k = 0; k < group->nfields; k++) {
    const Field *field = &group->field[k];
    const size_t bytes = Bytes(field, extent);
    if (!Travels(field, MessageHeaderOf(m)->flag)) continue;
    if (field->only == FIELD_SPARSE) {
      PackSparse(p, m, group, field, n, bytes, data);
      continue;
    }
    if (group->entry)
      PackEntries(m, group, field, n, bytes, data);
    else
      PackArray(p, m, group, field, n, bytes, data);
    if (field->type == FIELD_REAL)
      Check(p, group, field, NULL, n, FieldSize(field, extent),
            (const double *)(const void *)(m->buffer.data + m->last));
  }
}

/* --- unpacking ------------------------------------------------------------------------------------------ */

/* Bytes of one entity's value of a field of the message. */
static size_t BytesHere(Participant *p, Message *m, const Field *field)
{
  const MessageHeader *h = MessageHeaderOf(m);
  int extent[NEXTENTS];
  if (h->dim != p->dim)
    ParticipantFail(p, "%s rank %d sends fields in %d dimensions, this run has %d", ROLE_NAMES[m->role],
                    m->rank, h->dim, p->dim);
  FieldsExtents(p->dim, extent);
  return Bytes(field, extent);
}

void FieldsAppend(Participant *p, Message *m, const FieldGroup *group, size_t n, FieldLists *lists)
{
  for (int k = 0; k < group->nfields; k++) {
    const size_t bytes = n * BytesHere(p, m, &group->field[k]);
    if (!Travels(&group->field[k], MessageHeaderOf(m)->flag)) continue;
    const void *block = MessageTake(p, m, bytes);
    if (n) memcpy(BufferExtend(&lists->list[k], bytes), block, bytes);
  }
}

void FieldsView(const FieldGroup *group, const FieldLists *lists, int flags, void *structure)
{
  for (int k = 0; k < group->nfields; k++) {
    const void *array = Travels(&group->field[k], flags) ? lists->list[k].data : NULL;
    memcpy((char *)structure + group->field[k].offset, &array, sizeof array);
  }
}

static void TakeSparse(Participant *p, Message *m, size_t n, size_t entry, size_t bytes, char *to)
{
  size_t count = 0;
  const char *carries = MessageTake(p, m, n);
  for (size_t i = 0; i < n; i++) count += carries[i] != 0;
  const char *block = MessageTake(p, m, count * bytes);
  for (size_t i = 0; i < n; i++) {
    if (!carries[i]) continue;
    CopyValue(to + i * entry, block, bytes);
    block += bytes;
  }
}

void FieldsTake(Participant *p, Message *m, const FieldGroup *group, size_t n, Buffer *entries)
{
  char *to = BufferResize(entries, n * group->entry);
  if (n) memset(to, 0, n * group->entry); /* where a field has not travelled it is 0 */
  for (int k = 0; k < group->nfields; k++) {
    const Field *field = &group->field[k];
    const size_t bytes = BytesHere(p, m, field);
    if (field->only == FIELD_SPARSE) {
      TakeSparse(p, m, n, group->entry, bytes, to + field->offset);
    } else if (Travels(field, MessageHeaderOf(m)->flag)) {
      const char *block = MessageTake(p, m, n * bytes);
      for (size_t i = 0; i < n; i++)
        CopyValue(to + i * group->entry + field->offset, block + i * bytes, bytes);
    }
  }
}

void FieldListsClear(FieldLists *lists)
{
  for (int k = 0; k < FIELDS_MAX; k++) BufferResize(&lists->list[k], 0);
}

void FieldListsFree(FieldLists *lists)
{
  for (int k = 0; k < FIELDS_MAX; k++) BufferFree(&lists->list[k]);
}
