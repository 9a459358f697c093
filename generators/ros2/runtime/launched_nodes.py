"""Nodes of the robots that a launch starts, and of the process that they may share."""

import json
import os
from pathlib import Path
from tempfile import gettempdir, NamedTemporaryFile
from typing import Any, NamedTuple

from ament_index_python.packages import get_package_share_directory, PackageNotFoundError
from launch.actions import GroupAction, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode, Node, PushRosNamespace

from .robots import chosen, delay, RobotError


class Behavior(NamedTuple):
    """
    Node of a robot, for its own behaviour or that of a part, with its remapped topics.

    `watchdog` are the parameters of the node that calls a function when this one has died.
    """

    executable: str
    name: str
    part: str = ''
    remappings: Any = None
    watchdog: Any = None


class Swarm(NamedTuple):
    """
    A swarm with its roles by name; `package` has its nodes and their parameters.

    `bringup` is the package with the nodes of functions and components, `heartbeat` the seconds
    between heartbeats of a robot and without them until it is lost, `monitor` the executable that
    watches the properties. The robots of a swarm that is composed share a process.
    """

    package: str
    name: str
    roles: Any
    bringup: str = ''
    heartbeat: Any = None
    monitor: str = ''
    is_managed: bool = False
    is_composed: bool = False


class LaunchedNodes:
    """Nodes of the robots that are launched, as the arguments say."""

    def __init__(self, swarm, context):
        self._swarm = swarm
        self._context = context
        counts = {name: self._text(f'{name}_count') for name in swarm.roles}
        self._counts, self._robots = chosen(swarm.roles, self._text('members'), counts)
        self._namespace = self._text('namespace').strip('/')
        self._config = Path(folder_of(swarm.package), 'config', swarm.name)
        self._traces = self._made('trace_dir')
        self._logs = self._made('log_dir')
        self._delay = delay(self._text('respawn_delay'))

    def groups(self):
        """Return a group of nodes for each robot, and one for the monitor."""
        is_whole = not self._text('members').strip()
        has_monitor = self._swarm.monitor and is_whole and self._is_on('monitor')
        shared = [self._monitor()] if has_monitor else []
        if self._is_composed and self._robots:
            shared.append(self._container())
        return [*shared, *(self._robot(role, number) for role, number in self._robots)]

    @property
    def _is_composed(self):
        return self._swarm.is_composed and self._is_on('composed')

    def _robot(self, role, number):
        nodes = self._swarm.roles[role].nodes
        alone = () if self._is_composed else nodes
        return GroupAction(
            [
                PushRosNamespace(LaunchConfiguration('namespace')),
                PushRosNamespace(f'{role}_{number}'),
                *(self._behavior(role, number, node) for node in alone),
                *(self._server(role, number, name) for name in self._servers(role)),
                *(self._watchdog(role, number, node) for node in nodes if node.watchdog),
                *self._bringup(role, number),
            ]
        )

    def _behavior(self, role, number, node):
        """Return a node, with the parameters of the role and its own, which go before them."""
        parameters, paths = self._given(role, number, node)
        made = LifecycleNode if self._swarm.is_managed else Node
        return made(
            package=self._swarm.package,
            executable=node.executable,
            name=node.name,
            parameters=[parameters, *paths],
            remappings=node.remappings,
            respawn=self._is_on('respawn'),
            respawn_delay=self._delay,
            **({'namespace': ''} if self._swarm.is_managed else {}),
            **self._common(),
        )

    def _container(self):
        """Return the process with the nodes of all robots, which starts failed ones again."""
        respawn = ['--respawn', str(self._delay)] if self._is_on('respawn') else []
        nodes = [
            self._start(role, number, node)
            for role, number in self._robots
            for node in self._swarm.roles[role].nodes
        ]
        common = self._common()
        container = Node(
            package=self._swarm.package,
            executable='container',
            respawn=self._is_on('respawn'),
            respawn_delay=self._delay,
            **{**common, 'arguments': [*respawn, _written(nodes), *common['arguments']]},
        )
        return GroupAction([PushRosNamespace(LaunchConfiguration('namespace')), container])

    def _start(self, role, number, node):
        """Return the module, the namespace and the arguments of a node in the container."""
        parameters, paths = self._given(role, number, node)
        words = ['-r', f'__node:={node.name}']
        for old, new in node.remappings or ():
            words += ['-r', f'{old}:={new}']
        for name, value in parameters.items():
            words += ['-p', f'{name}:={json.dumps(value)}']
        for path in paths:
            words += ['--params-file', path]
        return [node.executable, f'{role}_{number}', words]

    def _given(self, role, number, node):
        """Return the parameters of a node, and the paths of files with more of them."""
        member = f'{role}[{number}]' + (f'.{node.part}' if node.part else '')
        parameters = {
            'member': member,
            'self.count': self._counts[role],
            'model.others': self._text('other_models'),
            'stay': self._is_on('respawn'),
            'use_sim_time': self._is_on('use_sim_time') or self._is_on('world'),
            **self._heartbeat(),
            **self._trace(member),
        }
        if node.watchdog:
            parameters['lease.file'] = self._lease(role, number, node)
        if self._swarm.is_managed:
            parameters['lifecycle.autostart'] = self._is_on('autostart')
        if self._is_on('world'):
            # The world hears what a robot sends there, and says there what reaches it by radio.
            parameters['swarm'] = f'/{self._namespace}/{role}_{number}/radio'
            # It does not pass on models.
            parameters['model.others'] = 'ignore'
        files = (f'{role}.yaml', f'{role}_{number}.model.yaml', f'{role}_{number}.yaml')
        paths = [self._config / file for file in files]
        return parameters, [str(path) for path in paths if path.exists()]

    def _servers(self, role):
        servers = self._swarm.roles[role].servers
        # A world has the servers of the functions.
        return servers if servers and self._is_on('servers') and not self._is_on('world') else ()

    def _server(self, role, number, name):
        own = self._config / f'{role}_{number}.yaml'
        parameters = {
            'member': f'{role}[{number}]',
            'use_sim_time': self._is_on('use_sim_time'),
        }
        return Node(
            package=self._swarm.package,
            executable=name,
            name=name,
            parameters=[parameters, *([str(own)] if own.exists() else [])],
            respawn=self._is_on('respawn'),
            respawn_delay=self._delay,
            **self._common(),
        )

    def _watchdog(self, role, number, node):
        lease = {'lease.file': self._lease(role, number, node)}
        return Node(
            package=self._swarm.package,
            executable='watchdog',
            name='watchdog',
            parameters=[{**node.watchdog, **lease}],
            respawn=True,
            **self._common(),
        )

    def _lease(self, role, number, node):
        """Return the file that a node locks while it lives; each user has own ones."""
        folder = Path(gettempdir(), f'swarm_leases_{os.getuid()}')
        domain = os.environ.get('ROS_DOMAIN_ID', '0')
        space = self._namespace.replace('/', '.')
        return str(folder / f'{domain}.{space}.{role}_{number}.{node.name}')

    def _monitor(self):
        parameters = {
            'members': self._members(),
            'use_sim_time': self._is_on('use_sim_time') or self._is_on('world'),
        }
        if self._traces:
            parameters['trace.file'] = str(Path(self._traces, 'monitor.jsonl'))
        node = Node(
            package=self._swarm.package,
            executable=self._swarm.monitor,
            name='monitor',
            parameters=[parameters],
            **self._common(),
        )
        return GroupAction([PushRosNamespace(LaunchConfiguration('namespace')), node])

    def _bringup(self, role, number):
        """Return the nodes of functions and components, if they are wanted and installed."""
        file = self._swarm.roles[role].bringup
        # A world has the servers of the functions.
        functions = file and self._is_on('functions') and not self._is_on('world')
        components = file and self._is_on('components')
        if not (functions or components):
            return []
        folder = folder_of(self._swarm.bringup)
        if not folder:
            what = f'package {self._swarm.bringup}, which target `skeleton` of swarmc writes'
            raise RobotError(f'functions and components need {what}: it is not installed')
        path = Path(folder, 'launch', file)
        if not path.exists():
            return []
        own = self._config / f'{role}_{number}.yaml'
        arguments = {
            # The group has set the namespace already.
            'namespace': '',
            'use_sim_time': LaunchConfiguration('use_sim_time'),
            'params_file': str(own) if own.exists() else '',
            'functions': 'true' if functions else 'false',
            'components': 'true' if components else 'false',
        }
        source = PythonLaunchDescriptionSource(str(path))
        return [IncludeLaunchDescription(source, launch_arguments=arguments.items())]

    def _common(self):
        """Return what all nodes have in common."""
        more = {'additional_env': {'ROS_LOG_DIR': self._logs}} if self._logs else {}
        arguments = ['--ros-args', '--log-level', LaunchConfiguration('log_level')]
        return {'arguments': arguments, 'output': 'screen', **more}

    def _heartbeat(self):
        if self._swarm.heartbeat is None:
            return {}
        period, timeout = self._swarm.heartbeat
        return {
            'heartbeat.period': period,
            'heartbeat.timeout': timeout,
            'heartbeat.members': self._members(),
        }

    def _members(self):
        """Return the robots of the whole swarm, divided by spaces."""
        counts = self._counts.items()
        return ' '.join(f'{role}[{number}]' for role, count in counts for number in range(count))

    def _trace(self, name):
        if not self._traces:
            return {}
        path = str(Path(self._traces, f'{name}.jsonl'))
        return {'trace.file': path, 'trace.keep': self._is_on('respawn')}

    def _made(self, argument):
        """Return a folder, which exists, or an empty string."""
        folder = self._text(argument)
        if folder:
            try:
                Path(folder).mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise RobotError(f'{argument} cannot be made: {error}') from None
        return folder

    def _text(self, argument):
        return LaunchConfiguration(argument).perform(self._context)

    def _is_on(self, argument):
        text = self._text(argument).lower()
        if text not in ('true', '1', 'false', '0'):
            raise RobotError(f'{argument} must be true or false, not `{text}`')
        return text in ('true', '1')


def _written(nodes):
    """
    Write the nodes of a process to a file, and return its path.

    A command is too short for those of hundreds of robots. The file stays for a respawn.
    """
    try:
        with NamedTemporaryFile('w', prefix='swarm_nodes_', suffix='.json', delete=False) as file:
            json.dump(nodes, file)
    except OSError as error:
        raise RobotError(f'the nodes of a process cannot be written: {error}') from None
    return file.name


def folder_of(package):
    """Return the folder of an installed package; an empty string if there is none."""
    try:
        return get_package_share_directory(package)
    except PackageNotFoundError:
        return ''
