@HEAD@
#include <math.h>

/* Where the hip is and how it moves: m and m/s; x forward, y up, flat ground at y = 0. */
typedef struct {
  double x, y, vx, vy;
} leg_hip;

typedef enum { LEG_FLIGHT, LEG_ROLLING, LEG_TOE, LEG_STANCE } leg_mode;

/* What the leg remembers from one call to the next. */
typedef struct {
  leg_mode mode;
  int placed;     /* in flight: the hip has been higher than touch-down height */
  double contact; /* m: @COORDINATE@ */
  double phi, f;  /* where the next search begins: contact arc [rad], load [-] */
} leg_state;

/* What the leg does at one instant. */
typedef struct {
  double fx, fy;       /* force on the hip [N]; on the ground the same, turned round */
  double chord_force;  /* along the chord [N], positive pushes the hip away */
  double torque;       /* of the hip [N m], positive pushes it forward */
  double contact_x;    /* place of the contact [m] */
  double length;       /* of the chord, contact to hip [m] */
  double arc;          /* contact arc [rad]; pi on the toe, 0 of a straight leg */
  double angle;        /* leg angle [rad] */
  double angle_rate;   /* its rate [rad/s] */
  double contact_rate; /* d contact/dt [m/s]: to be integrated by the caller; 0 of most laws */
} leg_load;

/* A leg in flight. */
void leg_start(leg_state *leg);
/* Torque the controller asks for at this speed [N m]. */
double leg_torque(double vx);
/* Leg angle at touch-down [rad], for an angle that is commanded. */
double leg_touchdown_angle(double commanded, double vx);
/* Height of the hip at which a leg at that angle meets the ground [m]. */
double leg_touchdown_height(double angle);
/* The load now. 0; or 1 where the law has no equilibrium: then nothing of `load` is to be used. */
int leg_load_at(leg_state *leg, const leg_hip *hip, leg_load *load);
/* The same with a torque of the motor that is known [N m]. */
int leg_load_driven(leg_state *leg, const leg_hip *hip, double motor, leg_load *load);
/* Flight, rolling or toe from here on; to be called after each step. A touch-down may change the
   velocity of the hip. Gives the mode. */
leg_mode leg_decide(leg_state *leg, leg_hip *hip, double commanded_angle);

#define LEG_PI 3.14159265358979323846
@DEFINES@
/* One instant of stance as the law has it. */
typedef struct {
  double u;            /* contact ahead of the hip [m] */
  double l, phi;       /* chord [m], contact arc [rad] */
  double elastic;      /* elastic force along the chord [N] */
  double rate;         /* what the damper sees [m/s] */
  double contact_rate; /* [m/s] */
  double angle;        /* leg angle at the hip [rad] */
  double angle_rate;   /* [rad/s] */
  double change;       /* stays positive until the leg rolls onto its toe, or off it */
  double rest;         /* chord at which it carries nothing [m] */
  double stiffness;    /* of a small load [N/m] */
  double viscous_x, viscous_y; /* force on the hip of a strip that damps along its arc [N] */
} leg_instant;
