/* Drones: 2 drone (landing.swarm:30)
 *
 * Property DownOnce: each drone : starts land only after sends Taken
 *
 * messages between robots arrive in any order, none is lost
 * functions, delays and messages take any time
 * functions succeed or are aborted, actions are also preempted
 * no robot and no answer of a function is lost
 *
 * spin -run -bfs Drones_DownOnce_drone_1.pml looks at all states, or finds a shortest run that violates it.
 * Each option of a process is one step of a robot, with what leads to it in the model.
 */

#define ROBOTS 2

/* states of 1 drone: drone[1] */
#define at_drone_1_Circle 0 /* Circle */
#define at_drone_1_Land 1 /* Land */
#define at_drone_1_Wait 2 /* Wait */
#define at_drone_1_Down 3 /* Down */
#define ended_drone_1(robot) (at[robot] == at_drone_1_Down)

/* states of 1 drone: drone[0] */
#define at_drone_0_Circle 0 /* Circle */
#define at_drone_0_Land 1 /* Land */
#define at_drone_0_Wait 2 /* Wait */
#define at_drone_0_Down 3 /* Down */
#define ended_drone_0(robot) (at[robot] == at_drone_0_Down)

byte at[ROBOTS] = { at_drone_1_Circle, at_drone_0_Circle };

/* events between robots; an inbox has the number of each on its way to a robot */
#define LETTERS 2
#define CAPACITY 2
#define letter_Taken 0 /* Taken */
#define letter_Free 1 /* Free */
#define inbox(robot, letter) inboxes[(robot) * LETTERS + letter]
#define waiting_Free(robot) (inbox(robot, letter_Free))
#define waiting_Taken(robot) (inbox(robot, letter_Taken))

byte inboxes[ROBOTS * LETTERS];
byte to; /* counts robots; 0 between steps */
byte letter;

inline send_Taken_from_drone_1(me) {
  for (to : 1 .. 1) {
    if
    :: !ended_drone_0(to) && waiting_Taken(to) < CAPACITY -> inbox(to, letter_Taken)++
    :: else
    fi
  }
  to = 0
}

inline send_Taken_from_drone_0(me) {
  for (to : 0 .. 0) {
    if
    :: !ended_drone_1(to) && waiting_Taken(to) < CAPACITY -> inbox(to, letter_Taken)++
    :: else
    fi
  }
  to = 0
}

inline send_Free_from_drone_1(me) {
  for (to : 1 .. 1) {
    if
    :: !ended_drone_0(to) && waiting_Free(to) < CAPACITY -> inbox(to, letter_Free)++
    :: else
    fi
  }
  to = 0
}

inline send_Free_from_drone_0(me) {
  for (to : 0 .. 0) {
    if
    :: !ended_drone_1(to) && waiting_Free(to) < CAPACITY -> inbox(to, letter_Free)++
    :: else
    fi
  }
  to = 0
}

inline end(me) { /* what is on its way to a robot that has ended does not count */
  for (letter : 0 .. LETTERS - 1) { inbox(me, letter) = 0 }
  letter = 0
}

/* the watch of the property */
#define SETTLED 1
#define VIOLATED 2
byte watch = 0;
byte count_0 = 0; /* robots: starts land */
byte count_1 = 0; /* robots: sends Taken */
byte my_count_0 = 0; /* the robot of the property: starts land */
byte my_count_1 = 0; /* the robot of the property: sends Taken */
#define claim_0 (my_count_0 >= 1) /* starts land */
#define claim_1 (my_count_1 >= 1) /* sends Taken */

inline look() {
  if
  :: watch == 0 && claim_0 && claim_1 -> watch = SETTLED
  :: watch == 0 && claim_0 && !claim_1 -> watch = VIOLATED
  :: watch == 0 && !claim_0 && claim_1 -> watch = SETTLED
  :: else
  fi
}

/* 1 drone: drone[1] */
active [1] proctype robot_drone_1() {
end_drone_1:
  do
  :: d_step { /* do.Circle.succeeded (landing.swarm:13) */
       at[_pid] == at_drone_1_Circle ->
       at[_pid] = at_drone_1_Land; send_Taken_from_drone_1(_pid); count_0++; my_count_0++; count_1++; my_count_1++; look(); count_0--; my_count_0--; count_1--; my_count_1--
     }
  :: d_step { /* do.Circle.aborted (landing.swarm:14) */
       at[_pid] == at_drone_1_Circle ->
       at[_pid] = at_drone_1_Circle; look()
     }
  :: d_step { /* Taken (landing.swarm:15) */
       at[_pid] == at_drone_1_Circle && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_1_Wait; look()
     }
  :: d_step { /* Free */
       at[_pid] == at_drone_1_Circle && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_1_Circle; look()
     }
  :: d_step { /* do.Land.succeeded (landing.swarm:20) */
       at[_pid] == at_drone_1_Land ->
       at[_pid] = at_drone_1_Down; end(_pid); send_Free_from_drone_1(_pid); look()
     }
  :: d_step { /* do.Land.aborted (landing.swarm:21) */
       at[_pid] == at_drone_1_Land ->
       at[_pid] = at_drone_1_Land; count_0++; my_count_0++; look(); count_0--; my_count_0--
     }
  :: d_step { /* Taken */
       at[_pid] == at_drone_1_Land && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_1_Land; look()
     }
  :: d_step { /* Free */
       at[_pid] == at_drone_1_Land && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_1_Land; look()
     }
  :: d_step { /* Taken */
       at[_pid] == at_drone_1_Wait && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_1_Wait; look()
     }
  :: d_step { /* Free (landing.swarm:17) */
       at[_pid] == at_drone_1_Wait && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_1_Circle; look()
     }
  od
}

/* 1 drone: drone[0] */
active [1] proctype robot_drone_0() {
end_drone_0:
  do
  :: d_step { /* do.Circle.succeeded (landing.swarm:13) */
       at[_pid] == at_drone_0_Circle ->
       at[_pid] = at_drone_0_Land; send_Taken_from_drone_0(_pid); count_0++; count_1++; look(); count_0--; count_1--
     }
  :: d_step { /* do.Circle.aborted (landing.swarm:14) */
       at[_pid] == at_drone_0_Circle ->
       at[_pid] = at_drone_0_Circle; look()
     }
  :: d_step { /* Taken (landing.swarm:15) */
       at[_pid] == at_drone_0_Circle && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_0_Wait; look()
     }
  :: d_step { /* Free */
       at[_pid] == at_drone_0_Circle && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_0_Circle; look()
     }
  :: d_step { /* do.Land.succeeded (landing.swarm:20) */
       at[_pid] == at_drone_0_Land ->
       at[_pid] = at_drone_0_Down; end(_pid); send_Free_from_drone_0(_pid); look()
     }
  :: d_step { /* do.Land.aborted (landing.swarm:21) */
       at[_pid] == at_drone_0_Land ->
       at[_pid] = at_drone_0_Land; count_0++; look(); count_0--
     }
  :: d_step { /* Taken */
       at[_pid] == at_drone_0_Land && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_0_Land; look()
     }
  :: d_step { /* Free */
       at[_pid] == at_drone_0_Land && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_0_Land; look()
     }
  :: d_step { /* Taken */
       at[_pid] == at_drone_0_Wait && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_0_Wait; look()
     }
  :: d_step { /* Free (landing.swarm:17) */
       at[_pid] == at_drone_0_Wait && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_0_Circle; look()
     }
  od
}

active proctype Watch() {
end_watch:
  watch == VIOLATED -> assert(false) /* the property does not hold */
}
