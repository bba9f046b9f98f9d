// The servo through Scilab's ode("root", ...), which is LSODAR, from event to event.
//
//   scilab-cli -nwni -f scilab_servo.sce -quit -args RESTITUTION TOLERANCE FILE
//
// FILE gets the seconds of the run and the samples (time, load, load speed) of its last seconds.
arguments = sciargs();
restitution = strtod(arguments($ - 2));
tolerance = strtod(arguments($ - 1));
file_name = arguments($);

damping = 0.19; inertia_ratio = 2; friction_ratio = 0.1; backlash = 0.3;
load_inertia = inertia_ratio / (1 + inertia_ratio);
motor_inertia = 1 - load_inertia;
load_friction = friction_ratio * 2 * damping;
motor_friction = 2 * damping - load_friction;

until = 200; recorded = 45; every = 0.01; // s
nudge = tolerance;      // off the face after a separation, else LSODAR finds the start as a root
bounce_nudge = 1e-13;   // the same after a bounce
last_bounce = 1e-5;     // the faces engage below this speed

// State: motor, load, motor speed, load speed.
flight_matrix = [0 0 1 0; 0 0 0 1; 0 -1/motor_inertia -motor_friction/motor_inertia 0; ..
                 0 0 0 -load_friction/load_inertia];
engaged_matrix = [0 0 1 0; 0 0 0 1; 0 -1 0 -2*damping; 0 -1 0 -2*damping];

function rate = flight(t, y)
  rate = flight_matrix * y
endfunction
function room = gap(t, y)
  room = [backlash/2 - (y(1) - y(2)); backlash/2 + (y(1) - y(2))]
endfunction
function rate = engaged(t, y)
  rate = engaged_matrix * y
endfunction
function torque = push(t, y)
  torque = face * (load_inertia * (-2*damping*y(4) - y(2)) + load_friction * y(4))
endfunction

tic();
t = 0; y = [-1; -1; 0; 0]; face = 0; samples = [];
while t < until
  times = t + (every:every:20);
  if face == 0 then
    [states, root] = ode("root", y, t, times, tolerance, tolerance, flight, 2, gap);
  else
    [states, root] = ode("root", y, t, times, tolerance, tolerance, engaged, 1, push);
  end
  if root == [] then
    error("no event");
  end
  count = size(states, 2);
  if t > until - recorded then
    samples = [samples; t y([2 4])'; [times(1:count - 1) root(1)]' states([2 4], :)'];
  end
  t = root(1); y = states(:, $);
  if face <> 0 then // separation
    y(1) = y(2) + face * (backlash/2 - nudge);
    face = 0;
  else // impact
    side = 3 - 2 * root(2);
    total = motor_inertia * y(3) + load_inertia * y(4);
    rebound = -restitution * (y(3) - y(4));
    if abs(rebound) < last_bounce then
      face = side; y(1) = y(2) + side * backlash/2; y(3:4) = total;
    else
      y(1) = y(2) + side * (backlash/2 - bounce_nudge);
      y(3) = total + load_inertia * rebound; y(4) = total - motor_inertia * rebound;
    end
  end
end
seconds = toc();

file = mopen(file_name, "w");
mfprintf(file, "%.17g\n", seconds);
mfprintf(file, "%.17g %.17g %.17g\n", samples);
mclose(file);
