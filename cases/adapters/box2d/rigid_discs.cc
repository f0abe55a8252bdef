/* Rigid discs that collide, roll and heap up, by Box2D, in place of coracle-solid in a case whose bodies are discs of one
 * radius and whose tank is `solid.walls`.
 *
 * Box2D computes in single precision and lets bodies overlap by 0.005 of its unit of length, which therefore is the radius
 * here.  A b2World cannot be copied: it is made anew from positions and velocities, in double precision, when a step begins,
 * so that a redone step has the same bits and a checkpoint is those arrays alone.  Rank 0 holds all. */
#include <algorithm>
#include <box2d/box2d.h>
#include <case_file.h>
#include <cmath>
#include <coracle.h>
#include <string>
#include <vector>

struct Motion { // of one disc
  double x[2], angle, v[2], spin;
};

struct Discs {
  CoracleClient client = nullptr;
  int n = 0;                                             // nodes on a circle; n + 1 of each disc, its centre last
  double radius = 0, corner = 0, mass = 0, inertia = 0;  // corner: radius of the nodes; the polygon has the disc's area
  double gravity[2], lower[2], upper[2], friction = 0, h = 0;
  std::vector<Motion> now;                               // bound
  std::vector<double> own;                               // bound: acceleration of nodes by all but the fluid, m/s2
  std::size_t Nodes() const { return now.size() * (n + 1); }
  double Mobility(std::size_t i) const { return (static_cast<int>(i % (n + 1)) < n ? 1.5 * n : 3.0) / mass; }
};

static void ReadCase(Discs &d, int argc, char **argv, bool empty)
{
  CoracleCase c;
  CoracleCaseOpen(argc, argv, CoracleFailMessage, d.client, &c);
  CoracleCaseVector(c, "gravity", 2, d.gravity);
  CoracleCaseVector(c, "solid.walls.lower", 2, d.lower);
  CoracleCaseVector(c, "solid.walls.upper", 2, d.upper);
  d.radius = CoracleCasePositive(c, "solid.bodies[0].radius");
  d.n = 6 * std::max(2, static_cast<int>(std::ceil(M_PI * d.radius / (3 * CoracleCasePositive(c, "solid.bodies[0].size")))));
  const std::string material = std::string("solid.materials.") + CoracleCaseString(c, "solid.bodies[0].material");
  d.friction = CoracleCaseNumberOr(c, (material + ".friction").c_str(), 0, 0, HUGE_VAL);
  d.corner = d.radius * std::sqrt(M_PI / (0.5 * d.n * std::sin(2 * M_PI / d.n)));
  d.mass = CoracleCasePositive(c, (material + ".density").c_str()) * M_PI * d.radius * d.radius;
  d.inertia = d.mass * d.corner * d.corner * (2 + std::cos(2 * M_PI / d.n)) / 6;
  d.h = CoracleCaseNumberOr(c, "solid.box2d.substep", 1e-3, 1e-6, 1);
  for (int b = 0; b < (empty ? 0 : CoracleCaseCount(c, "solid.bodies")); b++) {
    const std::string body = "solid.bodies[" + std::to_string(b) + "].";
    double centre[2], repeat[2] = {1, 1}, step[2] = {0, 0};
    CoracleCaseVector(c, (body + "centre").c_str(), 2, centre);
    if (CoracleCasePositive(c, (body + "radius").c_str()) != d.radius)
      CoracleCaseRefuse(c, (body + "radius").c_str(), "expected the radius of the first disc, %g m", d.radius);
    if (CoracleCaseHas(c, (body + "repeat").c_str())) {
      CoracleCaseVector(c, (body + "repeat.n").c_str(), 2, repeat);
      CoracleCaseVector(c, (body + "repeat.step").c_str(), 2, step);
    }
    for (int j = 0; j < repeat[1]; j++)
      for (int i = 0; i < repeat[0]; i++)
        d.now.push_back({{centre[0] + i * step[0], centre[1] + j * step[1]}, 0, {0, 0}, 0});
  }
  CoracleCaseClose(&c);
}

/* x[nodes][2], m, and v[nodes][2], m/s */
static void Nodes(const Discs &d, std::vector<double> &x, std::vector<double> &v)
{
  for (std::size_t i = 0; i < d.Nodes(); i++) {
    const Motion &m = d.now[i / (d.n + 1)];
    const int k = int(i % (d.n + 1));
    const double phi = m.angle + 2 * M_PI * k / d.n, r = k < d.n ? d.corner : 0;
    const double arm[2] = {r * std::cos(phi), r * std::sin(phi)};
    x[2 * i] = m.x[0] + arm[0];
    x[2 * i + 1] = m.x[1] + arm[1];
    v[2 * i] = m.v[0] - m.spin * arm[1];
    v[2 * i + 1] = m.v[1] + m.spin * arm[0];
  }
}

static void GiveMesh(const Discs &d, const std::vector<double> &x, const std::vector<double> &v)
{
  const int n = d.n, discs = static_cast<int>(d.now.size());
  std::vector<long long> gid(d.Nodes() + 1);
  std::vector<int> facet, slice;
  for (std::size_t i = 0; i < d.Nodes(); i++) gid[i] = static_cast<long long>(i);
  for (int b = 0; b < discs; b++)
    for (int i = 0, first = b * (n + 1); i < n; i++) {
      facet.insert(facet.end(), {first + i, first + (i + 1) % n});
      slice.insert(slice.end(), {first + n, first + i, first + (i + 1) % n});
    }
  CoracleSetNodes(d.client, 2, static_cast<int>(d.Nodes()), gid.data(), x.data(), v.data());
  CoracleSetSurface(d.client, n * discs, facet.data());
  CoracleSetVolume(d.client, n * discs, slice.data());
}

/* Box2D's unit of length is the radius; forces over mass and torques over moment of inertia are what matters. */
static b2Vec2 Scaled(const Discs &d, const double v[]) { return {float(v[0] / d.radius), float(v[1] / d.radius)}; }

static void Build(const Discs &d, b2World &world, std::vector<b2Body *> &body)
{
  b2BodyDef fixed;
  b2ChainShape tank; // clockwise: solid outside
  const double other[2][2] = {{d.upper[0], d.lower[1]}, {d.lower[0], d.upper[1]}};
  const b2Vec2 corner[4] = {Scaled(d, d.lower), Scaled(d, other[1]), Scaled(d, d.upper), Scaled(d, other[0])};
  tank.CreateLoop(corner, 4);
  world.CreateBody(&fixed)->CreateFixture(&tank, 0)->SetFriction(float(d.friction));
  for (const Motion &m : d.now) {
    b2BodyDef def;
    b2CircleShape circle;
    b2FixtureDef fixture;
    def.type = b2_dynamicBody;
    def.allowSleep = false;
    def.position = Scaled(d, m.x);
    def.linearVelocity = Scaled(d, m.v);
    def.angularVelocity = static_cast<float>(m.spin);
    circle.m_radius = 1; // the case's disc, not the circle of the nodes
    fixture.shape = &circle;
    fixture.friction = float(d.friction);
    body.push_back(world.CreateBody(&def));
    body.back()->CreateFixture(&fixture);
    const b2MassData mass{1, {0, 0}, static_cast<float>(d.inertia / (d.mass * d.radius * d.radius))};
    body.back()->SetMassData(&mass);
  }
}

/* One step of dt seconds under the fluid's force[nodes][2] on nodes at x. */
static void Advance(Discs &d, double dt, const double force[], const std::vector<double> &x)
{
  b2World world(Scaled(d, d.gravity));
  std::vector<b2Body *> body;
  Build(d, world, body);
  const int substeps = static_cast<int>(std::ceil(dt / d.h - 1e-9));
  std::vector<b2Vec2> start;
  for (const b2Body *b : body) start.push_back(b->GetPosition());
  for (int s = 0; s < substeps; s++) {
    for (std::size_t b = 0; b < body.size(); b++) {
      double f[2] = {0, 0}, moment = 0; // over the mass
      for (std::size_t k = 2 * b * (d.n + 1); k < 2 * (b + 1) * (d.n + 1); k += 2) {
        for (int c = 0; c < 2; c++) f[c] += force[k + c] / d.mass;
        moment += ((x[k] - d.now[b].x[0]) * force[k + 1] - (x[k + 1] - d.now[b].x[1]) * force[k]) / d.mass;
      }
      body[b]->ApplyForceToCenter(Scaled(d, f), true);
      body[b]->ApplyTorque(static_cast<float>(moment / (d.radius * d.radius)), true);
    }
    world.Step(static_cast<float>(dt / substeps), 10, 6);
  }
  for (std::size_t b = 0; b < body.size(); b++) { // displacements are added in double precision
    const b2Vec2 moved = body[b]->GetPosition() - start[b], v = body[b]->GetLinearVelocity();
    Motion &m = d.now[b];
    m = {{m.x[0] + moved.x * d.radius, m.x[1] + moved.y * d.radius}, m.angle + body[b]->GetAngle(),
         {v.x * d.radius, v.y * d.radius}, body[b]->GetAngularVelocity()};
  }
}

int main(int argc, char **argv)
{
  Discs d;
  MPI_Comm comm;
  CoracleAction action;
  const double *force;
  double t, dt;
  int rank;
  CoracleOpen("solid", argc, argv, &comm, &d.client);
  MPI_Comm_rank(comm, &rank);
  ReadCase(d, argc, argv, rank > 0);
  const std::size_t size = 2 * d.Nodes();
  std::vector<double> before(size), after(size), u(size), w(size), mobility;
  for (std::size_t k = 0; k < size; k++) d.own.push_back(d.gravity[k % 2]);
  for (std::size_t i = 0; i < d.Nodes(); i++) mobility.push_back(d.Mobility(i));
  CoracleBindState(d.client, d.now.data(), d.now.size() * sizeof(Motion));
  CoracleBindState(d.client, d.own.data(), size * sizeof(double));
  Nodes(d, before, u);
  GiveMesh(d, before, u);
  CoracleSetInertia(d.client, mobility.data(), d.own.data());
  CoracleReady(d.client);
  for (;;) {
    CoracleBegin(d.client, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    CoracleGetForce(d.client, &force);
    Nodes(d, before, u);
    Advance(d, dt, force, before);
    Nodes(d, after, w);
    for (std::size_t k = 0; k < size; k++) {
      d.own[k] = (w[k] - u[k]) / dt - mobility[k / 2] * force[k];
      u[k] = (after[k] - before[k]) / dt;
    }
    CoracleSubstep(d.client, dt, u.data());
    CoracleSetVelocity(d.client, w.data());
    CoracleSetInertia(d.client, mobility.data(), d.own.data());
    CoracleEnd(d.client, after.data());
  }
  double height = 0, overlap = 0; // m; of two discs or a disc and a wall, over the radius
  for (const Motion &m : d.now) {
    height += m.x[1] / static_cast<double>(d.now.size());
    for (int c = 0; c < 2; c++) overlap = std::fmax(overlap, 1 - std::fmin(m.x[c] - d.lower[c], d.upper[c] - m.x[c]) / d.radius);
    for (const Motion *o = &d.now[0]; o < &m; o++)
      overlap = std::fmax(overlap, 2 - std::hypot(m.x[0] - o->x[0], m.x[1] - o->x[1]) / d.radius);
  }
  CoracleReport(d.client, "mean_height", height, 1);
  CoracleReport(d.client, "overlap", overlap, 0);
  return CoracleClose(&d.client);
}
