# SPDX-License-Identifier: BSD-3-Clause
"""Computers of several robots on one machine: network namespaces on one link where the system lets them be made, and the
loopback where it does not."""
import contextlib
import dataclasses
import os
import re
import socket
import subprocess
import typing

PROBE = 'import socket,sys;s=socket.socket(socket.AF_INET,socket.SOCK_DGRAM);s.settimeout(5);'
LISTEN = PROBE + 's.bind(("",9));print(flush=True);s.recv(9)'
SHOUT = PROBE + 's.setsockopt(socket.SOL_SOCKET,socket.SO_BROADCAST,1);s.sendto(b"hello",(sys.argv[1],9))'


@dataclasses.dataclass
class Host:
    """Where a robot's processes run, and how its radio reaches the others'."""
    name: str
    enter: typing.List[str]   # words before a command that is to run there
    master_port: int
    radio_port: int
    broadcast: str            # address
    peers: str                # addresses, empty where broadcast reaches all


def ip(*words):
    subprocess.run(['ip', *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def remove(space):
    subprocess.run(['ip', 'netns', 'delete', space], check=False, stderr=subprocess.DEVNULL)


def remove_left_over():
    """Namespaces of tests that were killed."""
    listed = subprocess.run(['ip', 'netns', 'list'], check=True, capture_output=True, text=True).stdout
    for space, pid in re.findall(r'^(parley(\d+)\S*)', listed, re.M):
        if not os.path.exists(f'/proc/{pid}'):
            remove(space)


def separate(names, stack):
    """A namespace for each host and one for the bridge between them; whatever the hosts bind is theirs alone."""
    remove_left_over()
    air = f'parley{os.getpid()}'
    broadcast = '10.77.0.255'
    stack.callback(remove, air)
    ip('netns', 'add', air)
    ip('-n', air, 'link', 'add', 'air', 'type', 'bridge')
    ip('-n', air, 'link', 'set', 'air', 'up')
    hosts = []
    for number, name in enumerate(names, 1):
        space = f'{air}-{name}'
        stack.callback(remove, space)
        ip('netns', 'add', space)
        ip('-n', air, 'link', 'add', 'name', name, 'type', 'veth', 'peer', 'name', 'radio', 'netns', space)
        ip('-n', air, 'link', 'set', name, 'master', 'air', 'up')
        ip('-n', space, 'address', 'add', f'10.77.0.{number}/24', 'broadcast', broadcast, 'dev', 'radio')
        ip('-n', space, 'link', 'set', 'radio', 'up')
        ip('-n', space, 'link', 'set', 'lo', 'up')
        hosts.append(Host(name, ['ip', 'netns', 'exec', space], 11311, 47100, broadcast, ''))
    probe(hosts[0], hosts[-1], broadcast)
    return hosts


def probe(one, other, broadcast):
    """A datagram from one host must reach another: bridges are refused or filtered here and there."""
    python = ['/usr/bin/python3', '-c']
    with subprocess.Popen([*other.enter, *python, LISTEN], stdout=subprocess.PIPE) as listener:
        listener.stdout.readline()
        subprocess.run([*one.enter, *python, SHOUT, broadcast], check=True, stderr=subprocess.PIPE)
    if listener.returncode != 0:
        raise OSError('a datagram was lost on the bridge')


def free_ports(kind, count):
    """Ports that nobody has bound at this moment."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket(socket.AF_INET, kind)) for _ in range(count)]
        for each in sockets:
            each.bind(('127.0.0.1', 0))
        return [each.getsockname()[1] for each in sockets]


def together(names):
    """All on the loopback, told apart by their ports."""
    masters = free_ports(socket.SOCK_STREAM, len(names))
    radios = free_ports(socket.SOCK_DGRAM, len(names))
    peers = {port: ' '.join(f'127.0.0.1:{other}' for other in radios if other != port) for port in radios}
    return [Host(name, [], master, radio, '127.0.0.1', peers[radio]) for name, master, radio in zip(names, masters, radios)]


@contextlib.contextmanager
def hosts_for(names, loopback=False):
    """The hosts and what they are, in words."""
    with contextlib.ExitStack() as stack:
        found, kind = None, 'ports of the loopback, as asked'
        if not loopback:
            try:
                found, kind = separate(names, stack), 'network namespaces'
            except (OSError, subprocess.CalledProcessError) as error:
                kind = f'ports of the loopback, since namespaces are refused: {error}'
                stack.close()
        yield found or together(names), kind
