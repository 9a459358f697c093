/* Drones: 2 drone (landing.swarm:27)
 *
 * messages between robots arrive in any order, none is lost
 * functions, delays and messages take any time
 * functions succeed or are aborted, actions are also preempted
 * no robot and no answer of a function is lost
 *
 * spin -run -bfs Drones.pml looks at all states.
 * Each option of a process is one step of a robot, with what leads to it in the model.
 */

#define ROBOTS 2

/* states of 2 drone: drone[0], drone[1] */
#define at_drone_Circle 0 /* Circle */
#define at_drone_Land 1 /* Land */
#define at_drone_Wait 2 /* Wait */
#define at_drone_Down 3 /* Down */
#define ended_drone(robot) (at[robot] == at_drone_Down)

byte at[ROBOTS] = { at_drone_Circle, at_drone_Circle };

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

inline send_Taken_from_drone(me) {
  for (to : 0 .. 1) {
    if
    :: to != me && !ended_drone(to) && waiting_Taken(to) < CAPACITY -> inbox(to, letter_Taken)++
    :: else
    fi
  }
  to = 0
}

inline send_Free_from_drone(me) {
  for (to : 0 .. 1) {
    if
    :: to != me && !ended_drone(to) && waiting_Free(to) < CAPACITY -> inbox(to, letter_Free)++
    :: else
    fi
  }
  to = 0
}

inline end(me) { /* what is on its way to a robot that has ended does not count */
  for (letter : 0 .. LETTERS - 1) { inbox(me, letter) = 0 }
  letter = 0
}

/* 2 drone: drone[0], drone[1] */
active [2] proctype robot_drone() {
end_drone:
  do
  :: d_step { /* do.Circle.succeeded (landing.swarm:13) */
       at[_pid] == at_drone_Circle ->
       at[_pid] = at_drone_Land; send_Taken_from_drone(_pid)
     }
  :: d_step { /* Taken (landing.swarm:15) */
       at[_pid] == at_drone_Circle && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_Wait
     }
  :: d_step { /* Free */
       at[_pid] == at_drone_Circle && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_Circle
     }
  :: d_step { /* do.Land.succeeded (landing.swarm:20) */
       at[_pid] == at_drone_Land ->
       at[_pid] = at_drone_Down; end(_pid); send_Free_from_drone(_pid)
     }
  :: d_step { /* Taken */
       at[_pid] == at_drone_Land && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_Land
     }
  :: d_step { /* Free */
       at[_pid] == at_drone_Land && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_Land
     }
  :: d_step { /* Taken */
       at[_pid] == at_drone_Wait && inbox(_pid, letter_Taken) > 0 ->
       inbox(_pid, letter_Taken)--; at[_pid] = at_drone_Wait
     }
  :: d_step { /* Free (landing.swarm:17) */
       at[_pid] == at_drone_Wait && inbox(_pid, letter_Free) > 0 ->
       inbox(_pid, letter_Free)--; at[_pid] = at_drone_Circle
     }
  od
}
